/// \file
/// Proper rigid motions: a rotation about one point, then a move that takes it to another.
#pragma once

#include <numbers>

#include "math/frame.h"

namespace portalens {

/// `x -> to + R (x - from)`, `R` given by its rows, determinant +1. The two points are kept apart
/// so that a motion between places far from the origin loses no digits.
struct Rigid {
  Vec3d row_x{1, 0, 0}, row_y{0, 1, 0}, row_z{0, 0, 1};
  Vec3d from, to;

  [[nodiscard]] constexpr Vec3d rotate(Vec3d d) const {
    return {dot(row_x, d), dot(row_y, d), dot(row_z, d)};
  }
  [[nodiscard]] constexpr Vec3d rotate_back(Vec3d d) const {
    return row_x * d.x + row_y * d.y + row_z * d.z;
  }
  [[nodiscard]] constexpr Vec3d move(Vec3d point) const { return to + rotate(point - from); }
  [[nodiscard]] constexpr Vec3d move_back(Vec3d point) const {
    return from + rotate_back(point - to);
  }
  [[nodiscard]] constexpr Rigid inverse() const {
    return {{row_x.x, row_y.x, row_z.x},
            {row_x.y, row_y.y, row_z.y},
            {row_x.z, row_y.z, row_z.z},
            to,
            from};
  }
  [[nodiscard]] constexpr double determinant() const { return dot(row_x, cross(row_y, row_z)); }
};

/// First about x, then y, then z, each by degrees and right-handed, about `pivot`.
[[nodiscard]] inline Rigid rotation_about(Vec3d pivot, Vec3d degrees) {
  const double k = std::numbers::pi / 180.0;
  const double cx = std::cos(degrees.x * k), sx = std::sin(degrees.x * k);
  const double cy = std::cos(degrees.y * k), sy = std::sin(degrees.y * k);
  const double cz = std::cos(degrees.z * k), sz = std::sin(degrees.z * k);
  return {{cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx},
          {sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx},
          {-sy, cy * sx, cy * cx},
          pivot,
          pivot};
}

}  // namespace portalens
