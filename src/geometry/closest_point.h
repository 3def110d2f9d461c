/// \file
/// The point of a flat thing that is closest to a given one.
/// Triangles after Ericson, "Real-Time Collision Detection", sec. 5.1.5; larger convex polygons by
/// their plane and their edges.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include "geometry/ray.h"

namespace portalens {

/// Closest point of the segment from `a` to `b`; `a` if they coincide.
[[nodiscard]] inline Vec3d closest_on_segment(Vec3d a, Vec3d b, Vec3d x) {
  const Vec3d edge = b - a;
  const double square = dot(edge, edge);
  if (!(square > 0.0)) return a;
  return a + edge * std::clamp(dot(x - a, edge) / square, 0.0, 1.0);
}

/// Closest point of a convex planar polygon, from either side.
/// @param vertices  anything with size() and [], counter-clockwise about `normal`
/// @param normal    unit
template <class Vertices>
[[nodiscard]] Vec3d closest_on_polygon(const Vertices& vertices, Vec3d normal, Vec3d x) {
  const std::size_t count = vertices.size();
  bool inside = true;
  Vec3d best = vertices[0];
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d a = vertices[i], b = vertices[i + 1 == count ? 0 : i + 1];
    if (dot(cross(b - a, x - a), normal) >= 0.0) continue;
    inside = false;
    const Vec3d point = closest_on_segment(a, b, x);
    const double square = dot(x - point, x - point);
    if (square < least) least = square, best = point;
  }
  return inside ? x - normal * dot(x - vertices[0], normal) : best;
}

}  // namespace portalens
