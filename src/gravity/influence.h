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

/// Distance along a path from inside a ball to its surface, about: the path is x + t s + a s²/2, of
/// the direction t and the bend a.
[[nodiscard]] inline double exit_from(Vec3d center, double radius, const Ray& ray, Vec3d bend) {
  const Vec3d from = ray.origin - center;
  const double along = dot(from, ray.direction);
  const double inside = radius * radius - dot(from, from);
  if (inside <= 0.0) return std::fmax(0.0, -2.0 * along);
  double s = std::sqrt(along * along + inside) - along;
  // One step of Newton's method on |x + t s + a s²/2 - p|² = R².
  const Vec3d at = from + ray.direction * s + bend * (0.5 * s * s);
  const double slope = 2.0 * dot(at, ray.direction + bend * s);
  if (slope > 0.0) s -= (dot(at, at) - radius * radius) / slope;
  return std::fmax(s, 0.0);
}

}  // namespace portalens
