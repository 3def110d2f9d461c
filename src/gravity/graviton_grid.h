/// \file
/// The grid of a `graviton-map` on one portal's face: what the face passes on, node by node.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "gravity/coupling_input.h"

namespace portalens {

/// Nodes on a rectangle, its corners included. A cell is named by its lower left node.
///
/// What is interpolated has kinks at the lines of the grid. A cell with a kink that could be felt
/// is sharp: a step should end at its sides. The others may be run across.
class GravitonGrid {
 public:
  enum class Kind : std::uint8_t { empty, even, sharp };
  struct Cell {
    std::uint32_t i = 0, j = 0;
  };

  /// @param resolution  nodes along the longer side, >= 2; the spacing across is no larger
  /// @pre low < high
  GravitonGrid(double low_x, double low_y, double high_x, double high_y, int resolution);

  [[nodiscard]] std::uint32_t count_x() const { return count_x_; }
  [[nodiscard]] std::uint32_t count_y() const { return count_y_; }
  [[nodiscard]] double low_x() const { return low_x_; }
  [[nodiscard]] double low_y() const { return low_y_; }
  [[nodiscard]] double spacing_x() const { return spacing_x_; }
  [[nodiscard]] double spacing_y() const { return spacing_y_; }

  /// A place in the plane by shares of the spacing: node (2, 3) is at (2.0, 3.0).
  [[nodiscard]] Vec3d place(double i, double j) const {
    return {low_x_ + spacing_x_ * i, low_y_ + spacing_y_ * j, 0.0};
  }

  /// Fills the nodes with `value(Vec3d place)`, and tells the cells apart.
  /// @param unfelt  kinks count that put the field further off than this between two nodes
  template <class F>
  void fill(const F& value, double unfelt) {
    nodes_.reserve(static_cast<std::size_t>(count_x_) * count_y_);
    for (std::uint32_t j = 0; j < count_y_; ++j)
      for (std::uint32_t i = 0; i < count_x_; ++i) nodes_.push_back(value(place(i, j)));
    find_kinds(unfelt);
    find_sharp();
  }

  [[nodiscard]] const Pull& node(std::uint32_t i, std::uint32_t j) const {
    return nodes_[static_cast<std::size_t>(j) * count_x_ + i];
  }
  /// The cell of a place, or the nearest one.
  [[nodiscard]] Cell cell_at(Vec3d place) const;
  [[nodiscard]] Kind kind(Cell cell) const { return kinds_[index(cell)]; }
  /// How many cells further on the nearest sharp one is, straight or aslant: 0 if it is one itself,
  /// `none_sharp` if there is none.
  [[nodiscard]] std::uint32_t to_sharp(Cell cell) const { return to_sharp_[index(cell)]; }
  static constexpr std::uint32_t none_sharp = 1u << 20;
  /// A lower bound of the distance from a place in that cell to the nearest sharp one; infinite in
  /// a sharp one.
  [[nodiscard]] double distance_to_discontinuity(Cell cell, Vec3d at) const;
  /// The map at a place, from that cell; the scales by which steps are chosen are the cell's
  /// strictest.
  [[nodiscard]] Pull interpolate(Cell cell, Vec3d place) const;
  [[nodiscard]] double stiffness(Cell cell) const;
  [[nodiscard]] double nearness(Cell cell) const;
  [[nodiscard]] double gradient(Cell cell) const;

 private:
  [[nodiscard]] std::size_t index(Cell cell) const {
    return static_cast<std::size_t>(cell.j) * (count_x_ - 1) + cell.i;
  }
  void find_kinds(double unfelt);
  void find_sharp();
  /// By how much the map is off beside a node because its slope jumps there, at most.
  [[nodiscard]] double kink(std::uint32_t i, std::uint32_t j) const;

  double low_x_, low_y_, spacing_x_, spacing_y_;
  std::uint32_t count_x_, count_y_;
  std::vector<Pull> nodes_;
  std::vector<Kind> kinds_;  ///< of cells
  std::vector<std::uint32_t> to_sharp_;
};

}  // namespace portalens
