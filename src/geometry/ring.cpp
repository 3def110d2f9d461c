#include "geometry/ring.h"

#include <algorithm>
#include <numbers>

#include "geometry/extent.h"
#include "geometry/round.h"

namespace portalens {

Ring Ring::from(Parameters& parameters) {
  const Vec3d base = to_vec3(parameters.triple("base"));
  const double height = parameters.number("height", positive);
  const double inner = parameters.number("inner_radius", non_negative);
  const double outer = parameters.number("outer_radius", positive);
  const Vec3d rotation = to_vec3(parameters.triple("rotation", any_number, Triple{}));
  const Ring ring(base, height, inner, outer, rotation);
  const Ring other({}, 1.0, 0.5, 1.0, {});
  if (parameters.has("inner_radius") && parameters.has("outer_radius") && inner >= outer) {
    parameters.fault("inner_radius", "the inner radius is not smaller than the outer one",
                     "give an inner_radius below outer_radius");
    return other;
  }
  const double least = std::min({height, outer, std::fabs(outer - inner)});
  return extent_allowed(parameters, "base", ring.bounds(), least) ? ring : other;
}

Box Ring::bounds() const {
  Box box = pose_.disc(-half_, outer_);
  box.add(pose_.disc(half_, outer_));
  return box;
}

std::optional<Contact> Ring::intersect(const Ray& world, double low, double high) const {
  const CenteredRay ray = pose_.to_local(world);
  NearestContact nearest(low, high);
  consider_wall(nearest, ray, outer_, half_, 0);
  if (inner_ > 0.0) consider_wall(nearest, ray, inner_, half_, 1);
  consider_cap(nearest, ray, -half_, inner_, outer_, 2);
  consider_cap(nearest, ray, half_, inner_, outer_, 3);
  return nearest.best();
}

SurfacePoint Ring::surface_at(Vec3d x, std::uint32_t face) const {
  Vec3d local = pose_.to_local(x);
  if (face <= 1) {
    const Vec3d away = away_from_axis(local);
    const double radius = face == 0 ? outer_ : inner_;
    SurfacePoint point =
        pose_.point(away * radius + Vec3d{0, local.y, 0}, face == 0 ? away : -away);
    point.u = u_around(local);
    point.v = std::clamp(0.5 + 0.5 * local.y / half_, 0.0, 1.0);
    return point;
  }
  const double side = face == 2 ? -1.0 : 1.0;
  local.y = side * half_;
  SurfacePoint point = pose_.point(local, {0, side, 0});
  put_cap_coordinates(point, local, outer_, side);
  return point;
}

double Ring::distance(Vec3d local) const {
  const double radius = axis_distance(local), height = std::fabs(local.y);
  const double over = std::max(height - half_, 0.0);
  const double beside = std::max({radius - outer_, 0.0, inner_ - radius});
  if (over > 0.0 || beside > 0.0) return std::hypot(over, beside);
  const double walls = inner_ > 0.0 ? std::min(outer_ - radius, radius - inner_) : outer_ - radius;
  return std::min(walls, half_ - height);
}

/// The best of three bounds: a distance changes no faster than its point moves; the ring lies in
/// its outer cylinder; and it surrounds a hole in which only the inner wall is near.
double Ring::clearance(const Segment& segment) const {
  const Vec3d a = pose_.to_local(segment.a), b = pose_.to_local(segment.b);
  const double any = 0.5 * (distance(a) + distance(b) - length(b - a));
  const SolidCylinder hull{outer_, half_};
  const bool within_hull = hull.depth(a) > 0.0 || hull.depth(b) > 0.0;
  const double outside = within_hull ? 0.0 : convex_clearance(hull, a, b);
  const double hole = inner_ - std::max(axis_distance(a), axis_distance(b));
  return std::max({0.0, any, outside, hole});
}

double Ring::area() const {
  return 2.0 * std::numbers::pi * (outer_ + inner_) * (2.0 * half_ + outer_ - inner_);
}

SurfacePoint Ring::sample(double u1, double u2) const {
  const double cap = 0.5 * (outer_ - inner_) * (outer_ + inner_);  // areas, over 2 pi
  const std::array<double, 4> areas = {2.0 * half_ * outer_, 2.0 * half_ * inner_, cap, cap};
  double at = u1 * (areas[0] + areas[1] + 2.0 * cap);
  std::uint32_t face = 0;
  while (face < 3 && at >= areas[face]) at -= areas[face++];
  const double share = std::min(1.0, at / areas[face]);
  if (face <= 1) {
    const double radius = face == 0 ? outer_ : inner_;
    return surface_at(pose_.to_world(around_axis(radius, half_ * (2.0 * share - 1.0), u2)), face);
  }
  const double square = inner_ * inner_ + share * (outer_ * outer_ - inner_ * inner_);
  return surface_at(pose_.to_world(around_axis(std::sqrt(square), 0.0, u2)), face);
}

std::vector<FlatFace> Ring::flat_faces() const {
  return {flat_cap(pose_, 2, -half_, outer_), flat_cap(pose_, 3, half_, outer_)};
}

}  // namespace portalens
