/// \file
/// Values over a rectangle of nodes or cells that are counted from somewhere else.
#pragma once

#include <cstddef>
#include <vector>

namespace portalens {

template <class T>
class Grid {
 public:
  /// Lays it anew, with that value everywhere.
  void lay(int column, int row, int columns, int rows, const T& value) {
    left_ = column;
    top_ = row;
    columns_ = columns;
    rows_ = rows;
    values_.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), value);
  }

  [[nodiscard]] int left() const { return left_; }
  [[nodiscard]] int top() const { return top_; }
  [[nodiscard]] int right() const { return left_ + columns_; }
  [[nodiscard]] int bottom() const { return top_ + rows_; }
  [[nodiscard]] std::size_t size() const { return values_.size(); }

  /// @pre left() <= column < right(), top() <= row < bottom()
  [[nodiscard]] T& at(int column, int row) { return values_[index(column, row)]; }
  [[nodiscard]] const T& at(int column, int row) const { return values_[index(column, row)]; }

 private:
  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row - top_) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column - left_);
  }

  int left_ = 0, top_ = 0, columns_ = 0, rows_ = 0;
  std::vector<T> values_;
};

}  // namespace portalens
