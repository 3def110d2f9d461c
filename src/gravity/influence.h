/// \file
/// Spheres in which masses act, and rays.
#pragma once

#include <cmath>
#include <limits>

#include "geometry/ray.h"

namespace portalens {

/// Distance along the ray, > 0, to the surface of the ball from outside; infinity if it is missed
/// or lies behind; 0 from inside.
[[nodiscard]] inline double entry_into(Vec3d center, double radius, const Ray& ray) {
  const Vec3d to = center - ray.origin;
  const double along = dot(to, ray.direction);
  const double outside = dot(to, to) - radius * radius;
  if (outside <= 0.0) return 0.0;
  if (along <= 0.0) return std::numeric_limits<double>::infinity();
  const Vec3d across = to - ray.direction * along;
  const double half2 = radius * radius - dot(across, across);
  if (half2 <= 0.0) return std::numeric_limits<double>::infinity();
  return outside / (along + std::sqrt(half2));
}

}  // namespace portalens
