#include "shading/reflection.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/frame.h"

namespace portalens {
namespace {

/// Smith's Λ of GGX for a unit direction in the surface's frame (`z` along the normal).
double smith_lambda(Vec3d w, double alpha) {
  const double tan2 = (w.x * w.x + w.y * w.y) / (w.z * w.z);
  return 0.5 * (std::sqrt(1.0 + alpha * alpha * tan2) - 1.0);
}

/// A microfacet's normal as seen from `w`. Heitz 2018, listing 1.
Vec3d visible_normal(Vec3d w, double alpha, double u1, double u2) {
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

Vec3d mirrored(Vec3d incoming, Vec3d normal) {
  return normalize(incoming - normal * (2.0 * dot(incoming, normal)));
}

}  // namespace

std::optional<Reflection> reflect(Vec3d incoming, Vec3d normal, double roughness, double u1,
                                  double u2) {
  const double alpha = roughness * roughness;
  if (alpha == 0.0) return Reflection{mirrored(incoming, normal), 1.0};
  const Vec3d right = any_perpendicular(normal);
  const Frame frame{{}, right, cross(normal, right), normal};
  const Vec3d out = frame.direction_to_local(-incoming);
  if (!(out.z > 0.0)) return std::nullopt;
  const Vec3d in = mirrored(-out, visible_normal(out, alpha, u1, u2));
  if (!(in.z > 0.0)) return std::nullopt;
  const double lambda = smith_lambda(out, alpha);
  const double weight = (1.0 + lambda) / (1.0 + lambda + smith_lambda(in, alpha));
  return Reflection{normalize(frame.direction_to_world(in)), weight};
}

}  // namespace portalens
