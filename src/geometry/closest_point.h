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

/// Closest point of the triangle, by the region of its plane below `x`.
[[nodiscard]] inline Vec3d closest_on_triangle(Vec3d a, Vec3d b, Vec3d c, Vec3d x) {
  const Vec3d ab = b - a, ac = c - a;
  const double d1 = dot(ab, x - a), d2 = dot(ac, x - a);
  if (d1 <= 0.0 && d2 <= 0.0) return a;
  const double d3 = dot(ab, x - b), d4 = dot(ac, x - b);
  if (d3 >= 0.0 && d4 <= d3) return b;
  const double beyond_ab = d1 * d4 - d3 * d2;
  if (beyond_ab <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + ab * (d1 / (d1 - d3));
  const double d5 = dot(ab, x - c), d6 = dot(ac, x - c);
  if (d6 >= 0.0 && d5 <= d6) return c;
  const double beyond_ac = d5 * d2 - d1 * d6;
  if (beyond_ac <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + ac * (d2 / (d2 - d6));
  const double beyond_bc = d3 * d6 - d5 * d4;
  if (beyond_bc <= 0.0 && d4 >= d3 && d5 >= d6)
    return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  const double sum = beyond_ab + beyond_ac + beyond_bc;
  return a + ab * (beyond_ac / sum) + ac * (beyond_ab / sum);
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
