#include "geometry/cone.h"

#include <algorithm>
#include <numbers>

#include "geometry/closest_point.h"
#include "geometry/extent.h"
#include "geometry/round.h"

namespace portalens {
namespace {

struct Solid {
  double radius, half;

  [[nodiscard]] double slant() const { return std::hypot(radius, 2.0 * half); }
  [[nodiscard]] double depth(Vec3d p) const {
    const double side = (radius * (half - p.y) - 2.0 * half * axis_distance(p)) / slant();
    return std::min(side, p.y + half);
  }
  [[nodiscard]] Vec3d closest(Vec3d p) const {
    if (depth(p) > 0.0) return p;
    const Vec3d out = away_from_axis(p);
    const Vec3d rim = out * radius - Vec3d{0, half, 0};
    const Vec3d on_base = closest_on_segment({0, -half, 0}, rim, p);
    const Vec3d on_side = closest_on_segment({0, half, 0}, rim, p);
    return length(p - on_base) < length(p - on_side) ? on_base : on_side;
  }
};

}  // namespace

Cone Cone::from(Parameters& parameters) {
  const Vec3d base = to_vec3(parameters.triple("base"));
  const double height = parameters.number("height", positive);
  const double radius = parameters.number("radius", positive);
  const Vec3d rotation = to_vec3(parameters.triple("rotation", any_number, Triple{}));
  const Cone cone(base, height, radius, rotation);
  const double least = std::min(height, radius);
  if (!extent_allowed(parameters, "base", cone.bounds(), least)) return {{}, 1.0, 1.0, {}};
  return cone;
}

Box Cone::bounds() const {
  Box box = pose_.disc(-half_, radius_);
  box.add(pose_.to_world({0, half_, 0}));
  return box;
}

/// With Y the depth below the tip and k = radius / height, the side is x² + z² = (k Y)², 0 <= Y <=
/// height. Scaled by 1 / (1 + k²), so that the terms stay small for flat cones too.
std::optional<Contact> Cone::intersect(const Ray& world, double low, double high) const {
  const CenteredRay ray = pose_.to_local(world);
  const Vec3d &o = ray.origin, &d = ray.direction;
  const double slant = std::hypot(radius_, 2.0 * half_);
  const double s = radius_ / slant, c = 2.0 * half_ / slant;  // of half the angle at the tip
  const double below = half_ - o.y;
  NearestContact nearest(low, high);
  const double from = c * axis_distance(o) - s * below;
  const double to = c * axis_distance(o) + s * below;
  const double square = c * c * (d.x * d.x + d.z * d.z) - s * s * d.y * d.y;
  const double twist = c * c * (o.x * d.x + o.z * d.z) + s * s * below * d.y;
  const double tolerance = 2.0 * std::fabs(square) * c * radius_ * ray.rounding;
  for (const double distance : roots(square, twist, from * to, tolerance)) {
    const double height = o.y + d.y * distance;
    if (within(std::fabs(height), half_, slant)) nearest.consider(ray.offset + distance, 0);
  }
  consider_cap(nearest, ray, -half_, 0.0, radius_, 1);
  return nearest.best();
}

SurfacePoint Cone::surface_at(Vec3d x, std::uint32_t face) const {
  Vec3d local = pose_.to_local(x);
  if (face == 1) {
    local.y = -half_;
    SurfacePoint point = pose_.point(local, {0, -1, 0});
    put_cap_coordinates(point, local, radius_, -1.0);
    return point;
  }
  const double slant = std::hypot(radius_, 2.0 * half_);
  const Vec3d out = away_from_axis(local);
  const Vec3d normal = (out * (2.0 * half_) + Vec3d{0, radius_, 0}) / slant;
  local += normal * dot(Vec3d{0, half_, 0} - local, normal);
  SurfacePoint point = pose_.point(local, normal);
  point.u = u_around(local);
  point.v = std::clamp(0.5 + 0.5 * local.y / half_, 0.0, 1.0);
  return point;
}

double Cone::clearance(const Segment& segment) const {
  return convex_clearance(Solid{radius_, half_}, pose_.to_local(segment.a),
                          pose_.to_local(segment.b));
}

double Cone::area() const {
  return std::numbers::pi * radius_ * (radius_ + std::hypot(radius_, 2.0 * half_));
}

SurfacePoint Cone::sample(double u1, double u2) const {
  const double slant = std::hypot(radius_, 2.0 * half_);
  const double at = u1 * (slant + radius_);
  const std::uint32_t face = at < slant ? 0 : 1;
  const double share = std::sqrt(std::min(1.0, face == 0 ? at / slant : (at - slant) / radius_));
  const double height = face == 0 ? half_ * (1.0 - 2.0 * share) : -half_;
  return surface_at(pose_.to_world(around_axis(radius_ * share, height, u2)), face);
}

std::vector<FlatFace> Cone::flat_faces() const { return {flat_cap(pose_, 1, -half_, radius_)}; }

}  // namespace portalens
