/// \file
/// Parts of a picture: windows, and the tiles they are cut into.
#pragma once

#include <algorithm>
#include <cstddef>

namespace portalens {

/// Pixels x0 <= x < x1, y0 <= y < y1, counted from the top left of the whole picture.
struct Window {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  [[nodiscard]] int width() const { return x1 - x0; }
  [[nodiscard]] int height() const { return y1 - y0; }
  [[nodiscard]] std::size_t pixels() const {
    return static_cast<std::size_t>(width()) * static_cast<std::size_t>(height());
  }
  [[nodiscard]] bool empty() const { return x0 >= x1 || y0 >= y1; }
  /// Whether every pixel of `other` is one of these.
  [[nodiscard]] bool holds(const Window& other) const {
    return x0 <= other.x0 && y0 <= other.y0 && other.x1 <= x1 && other.y1 <= y1;
  }
  friend bool operator==(const Window&, const Window&) = default;
};

/// The pixels that lie in both; it may be empty.
[[nodiscard]] inline Window common_part(const Window& a, const Window& b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

/// A window cut into squares, smaller at its right and lower edges, counted row by row.
class Tiling {
 public:
  /// @pre size >= 1, and the window is not empty
  Tiling(const Window& window, int size)
      : window_(window), size_(size), columns_((window.width() - 1) / size + 1) {}

  [[nodiscard]] std::size_t count() const {
    return static_cast<std::size_t>(columns_) *
           (static_cast<std::size_t>((window_.height() - 1) / size_) + 1);
  }
  [[nodiscard]] Window operator[](std::size_t i) const {
    const int x = window_.x0 + static_cast<int>(i % columns_) * size_;
    const int y = window_.y0 + static_cast<int>(i / columns_) * size_;
    return {x, y, x + std::min(size_, window_.x1 - x), y + std::min(size_, window_.y1 - y)};
  }

 private:
  Window window_;
  int size_;
  int columns_;
};

}  // namespace portalens
