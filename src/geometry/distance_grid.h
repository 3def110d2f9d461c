/// \file
/// How far from a place a mesh is, at a glance: a grid over its box that bounds it from below.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/mesh.h"

namespace portalens {

/// Immutable, safe from any thread. A look-up costs as much whatever the number of triangles, and
/// far less than a search for the nearest. It takes up to 64 bytes a triangle, at least 4 kB and at
/// most 1 MB.
class DistanceGrid {
 public:
  /// @pre the mesh has triangles
  explicit DistanceGrid(const Mesh& mesh);

  /// A lower bound of the distance to any triangle. What it falls short by, within the mesh's box,
  /// is a few cells.
  [[nodiscard]] double clearance(Vec3d x) const;

  /// Where the ray comes so near the mesh that something may lie within `radius` of it: nothing
  /// does from `low` up to there. Beyond `high` if nothing does up to that.
  /// @pre low and high are finite
  [[nodiscard]] double free_until(const Ray& ray, double low, double high, double radius) const;

  /// The side of a cell.
  [[nodiscard]] double cell() const { return cell_; }

 private:
  /// The cell that a place lies in, or is nearest to.
  [[nodiscard]] std::array<int, 3> cell_at(Vec3d x) const;

  Vec3d low_, high_;                ///< of the mesh's box
  double cell_ = 0.0;               ///< length of its sides
  double per_cell_ = 0.0;           ///< 1/length
  double slack_ = 0.0;              ///< more than rounding can make of a place
  std::array<int, 3> count_{};      ///< of cells
  std::vector<std::uint8_t> free_;  ///< from anywhere in a cell, in quarters of its side
};

}  // namespace portalens
