/// \file
/// Flat faces that may lie in one plane: whether two of them do, share an area there, and which of
/// them is met where both are.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "geometry/flush.h"
#include "geometry/polygon.h"
#include "geometry/ray.h"
#include "math/vec3.h"

namespace portalens {

/// Faces no further from each other's plane than this share of their size and place lie in it.
inline constexpr double same_plane = 1e-9;

/// A face as it is held against others.
struct FlushFace {
  FaceId id;
  bool opening = false;
  Vec3d normal;
  std::vector<Vec3d> hull;
  std::vector<std::vector<Vec3d>> pieces;  ///< none where the hull is all
  Box box;
  double extent = 0.0;      ///< of the object it is a face of; of a mesh, of its flat region
  double coordinate = 0.0;  ///< the largest

  void set_hull(std::vector<Vec3d> vertices) {
    hull = std::move(vertices);
    for (const Vec3d& vertex : hull) {
      box.add(vertex);
      coordinate = std::max(coordinate, largest_component(vertex));
    }
  }
};

/// How far two faces may lie from one plane.
[[nodiscard]] inline double tolerance_of(const FlushFace& a, const FlushFace& b) {
  return same_plane * (std::max(a.coordinate, b.coordinate) + std::min(a.extent, b.extent));
}

[[nodiscard]] bool in_one_plane(const FlushFace& a, const FlushFace& b);

/// Whether two boxes are no further apart than that along any axis.
[[nodiscard]] inline bool touch(const Box& a, const Box& b, double tolerance) {
  return a.low.x <= b.high.x + tolerance && b.low.x <= a.high.x + tolerance &&
         a.low.y <= b.high.y + tolerance && b.low.y <= a.high.y + tolerance &&
         a.low.z <= b.high.z + tolerance && b.low.z <= a.high.z + tolerance;
}

/// Whether two faces of one plane share more than an edge; by its rounding they may.
[[nodiscard]] bool share_area(const FlushFace& a, const FlushFace& b);

/// Whether `a` is met where both are.
[[nodiscard]] bool comes_before(const FlushFace& a, const FlushFace& b);

}  // namespace portalens
