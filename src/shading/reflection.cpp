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

/// What a pair of directions asks of the distribution.
struct Facets {
  double normals = 0.0;  ///< D of the facets that mirror one into the other; 0: no pair
  double cos_out = 1.0, cos_in = 1.0;
  double lambda_out = 0.0, lambda_in = 0.0;

  Facets(Vec3d normal, Vec3d out, Vec3d in, double roughness)
      : cos_out(dot(normal, out)), cos_in(dot(normal, in)) {
    const double alpha = roughness * roughness;
    if (alpha == 0.0 || !(cos_out > 0.0) || !(cos_in > 0.0)) return;
    const double cos_facet = dot(normal, normalize(out + in));
    const double bracket = 1.0 + cos_facet * cos_facet * (alpha * alpha - 1.0);
    normals = alpha * alpha / (std::numbers::pi * bracket * bracket);
    lambda_out = lambda(cos_out, alpha);
    lambda_in = lambda(cos_in, alpha);
  }

 private:
  static double lambda(double cosine, double alpha) {
    return smith_lambda({std::sqrt(std::max(0.0, 1.0 - cosine * cosine)), 0.0, cosine}, alpha);
  }
};

}  // namespace

double reflection_value(Vec3d normal, Vec3d out, Vec3d in, double roughness) {
  const Facets facets(normal, out, in, roughness);
  const double seen = 1.0 / (1.0 + facets.lambda_out + facets.lambda_in);
  return std::numbers::pi * facets.normals * seen / (4.0 * facets.cos_out * facets.cos_in);
}

double reflection_density(Vec3d normal, Vec3d out, Vec3d in, double roughness) {
  const Facets facets(normal, out, in, roughness);
  return facets.normals / ((1.0 + facets.lambda_out) * 4.0 * facets.cos_out);
}

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
