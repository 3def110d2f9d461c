/// \file
/// Lower bounds of the distance between a segment and a surface.
///
/// The distance to a convex body is a convex function: along a segment it lies above its tangents
/// at both ends, and these two give the bound. Inside a convex body the distance to the surface is
/// concave: along a segment it is least at an end.
#pragma once

#include <algorithm>
#include <cmath>

#include "geometry/ray.h"

namespace portalens {

/// The distance from one end of a segment, and how fast it grows with the share of the segment
/// that has been walked (from a to b, at both ends).
struct Approach {
  double distance = 0.0;
  double slope = 0.0;

  [[nodiscard]] static Approach to(Vec3d closest, Vec3d from, Vec3d way) {
    const Vec3d away = from - closest;
    const double distance = length(away);
    return {distance, distance > 0.0 ? dot(away, way) / distance : 0.0};
  }
};

/// The least that a convex function can be on [0, 1], from its values and slopes at the ends;
/// not below 0.
[[nodiscard]] inline double least_between(const Approach& a, const Approach& b) {
  if (!(a.slope < 0.0)) return a.distance;
  if (!(b.slope > 0.0)) return b.distance;
  const double meet = (b.distance - b.slope - a.distance) / (a.slope - b.slope);
  return std::max(0.0, std::min(a.distance + a.slope * meet, a.distance));
}

/// @param solid  closest(p): its point closest to p; depth(p): how far p is inside, to its surface,
///               0 or less outside
template <class Solid>
[[nodiscard]] double convex_clearance(const Solid& solid, Vec3d a, Vec3d b) {
  const double depth_a = solid.depth(a), depth_b = solid.depth(b);
  if (depth_a > 0.0 && depth_b > 0.0) return std::min(depth_a, depth_b);
  if (depth_a > 0.0 || depth_b > 0.0) return 0.0;
  return least_between(Approach::to(solid.closest(a), a, b - a),
                       Approach::to(solid.closest(b), b, b - a));
}

}  // namespace portalens
