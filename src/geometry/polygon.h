/// \file
/// What quads and the triangles of meshes have in common: convex planar polygons.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "geometry/clearance.h"
#include "geometry/closest_point.h"

namespace portalens {

[[nodiscard]] inline double largest_component(Vec3d a) {
  return std::max(std::fabs(a.x), std::max(std::fabs(a.y), std::fabs(a.z)));
}

/// Distance along the line of `ray` at which it crosses the polygon, from either side.
///
/// The line passes on one side of each edge by the sign of a volume (Plücker). Lines within 1e-12
/// of the longest edge of the rim, or within rounding, still cross: polygons that share an edge or
/// a vertex leave no gap. A line within the plane meets nothing.
/// @param vertices  anything with size() and []
/// @param normal    unit, of its plane
template <class Vertices>
[[nodiscard]] std::optional<double> line_through_polygon(const Vertices& vertices, Vec3d normal,
                                                         const Ray& ray) {
  constexpr double rounding = 1e-15, overlap = 1e-12;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::size_t count = vertices.size();
  double least = infinity, most = -infinity, nearest = infinity, farthest = -infinity;
  double reach = 0.0, longest = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d from = vertices[i] - ray.origin;
    const Vec3d edge = vertices[i + 1 == count ? 0 : i + 1] - vertices[i];
    const double volume = dot(edge, cross(ray.direction, from));
    const double along = dot(from, ray.direction);
    least = std::min(least, volume), most = std::max(most, volume);
    nearest = std::min(nearest, along), farthest = std::max(farthest, along);
    reach = std::max(reach, largest_component(from));
    longest = std::max(longest, largest_component(edge));
  }
  const double tolerance = longest * (rounding * reach + overlap * longest);
  const bool one_way = least >= -tolerance, other_way = most <= tolerance;
  if (one_way == other_way) return std::nullopt;
  const double slope = dot(normal, ray.direction);
  const double distance = dot(vertices[0] - ray.origin, normal) / slope;
  if (!std::isfinite(distance)) return std::nullopt;
  return std::min(std::max(distance, nearest), farthest);
}

/// A lower bound of the distance between a segment and a convex planar polygon.
template <class Vertices>
[[nodiscard]] double polygon_clearance(const Vertices& vertices, Vec3d normal,
                                       const Segment& segment) {
  const auto approach = [&](Vec3d from, Vec3d way) {
    return Approach::to(closest_on_polygon(vertices, normal, from), from, way);
  };
  const double height_a = dot(segment.a - vertices[0], normal);
  const double height_b = dot(segment.b - vertices[0], normal);
  const double plane =
      height_a * height_b > 0.0 ? std::min(std::fabs(height_a), std::fabs(height_b)) : 0.0;
  const Vec3d way = segment.b - segment.a;
  return std::max(plane, least_between(approach(segment.a, way), approach(segment.b, way)));
}

}  // namespace portalens
