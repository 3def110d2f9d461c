/// \file
/// The GGX distribution of microfacets: Walter et al. 2007. Directions are unit vectors in the
/// surface's frame, `z` along its normal.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/frame.h"
#include "math/vec3.h"

namespace portalens::ggx {

/// Smith's Λ.
[[nodiscard]] inline double smith_lambda(Vec3d w, double alpha) {
  const double tan2 = (w.x * w.x + w.y * w.y) / (w.z * w.z);
  return 0.5 * (std::sqrt(1.0 + alpha * alpha * tan2) - 1.0);
}

/// D, the density of the microfacets' normals, per solid angle and area of the surface.
[[nodiscard]] inline double distribution(Vec3d half, double alpha) {
  const double a2 = alpha * alpha;
  // cos² (a² - 1) + 1, without losing all digits where it is small.
  const double bracket = half.z * half.z * a2 + (half.x * half.x + half.y * half.y);
  return a2 / (std::numbers::pi * bracket * bracket);
}

/// A microfacet's normal as seen from `w`, its density D G1 (w·m) / cos. Heitz, "Sampling the GGX
/// Distribution of Visible Normals", JCGT 7(4), 2018, listing 1.
/// @param u1,u2  uniform in [0, 1)
[[nodiscard]] inline Vec3d visible_normal(Vec3d w, double alpha, double u1, double u2) {
  const Vec3d view = normalize(Vec3d{alpha * w.x, alpha * w.y, w.z});
  const double flat = std::sqrt(view.x * view.x + view.y * view.y);
  const Vec3d first = flat > 0.0 ? Vec3d{-view.y / flat, view.x / flat, 0.0} : Vec3d{1, 0, 0};
  const Vec3d second = cross(view, first);
  const double radius = std::sqrt(u1), angle = 2.0 * std::numbers::pi * u2;
  const double a = radius * std::cos(angle);
  const double share = 0.5 * (1.0 + view.z);
  const double b =
      (1.0 - share) * std::sqrt(std::max(0.0, 1.0 - a * a)) + share * radius * std::sin(angle);
  const Vec3d n = first * a + second * b + view * std::sqrt(std::max(0.0, 1.0 - a * a - b * b));
  return normalize(Vec3d{alpha * n.x, alpha * n.y, std::max(1e-12, n.z)});
}

/// Where light goes on that flies along `incoming`.
[[nodiscard]] inline Vec3d mirrored(Vec3d incoming, Vec3d normal) {
  return normalize(incoming - normal * (2.0 * dot(incoming, normal)));
}

/// The frame of a surface; any, about its normal.
[[nodiscard]] inline Frame frame_about(Vec3d normal) {
  const Vec3d right = any_perpendicular(normal);
  return {{}, right, cross(normal, right), normal};
}

}  // namespace portalens::ggx
