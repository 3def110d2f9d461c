#include "geometry/cylinder.h"

#include <algorithm>
#include <numbers>

#include "geometry/extent.h"
#include "geometry/round.h"

namespace portalens {

Cylinder Cylinder::from(Parameters& parameters) {
  const Vec3d base = to_vec3(parameters.triple("base"));
  const double height = parameters.number("height", positive);
  const double radius = parameters.number("radius", positive);
  const Vec3d rotation = to_vec3(parameters.triple("rotation", any_number, Triple{}));
  const Cylinder cylinder(base, height, radius, rotation);
  const double least = std::min(height, radius);
  if (!extent_allowed(parameters, "base", cylinder.bounds(), least)) return {{}, 1.0, 1.0, {}};
  return cylinder;
}

Box Cylinder::bounds() const {
  Box box = pose_.disc(-half_, radius_);
  box.add(pose_.disc(half_, radius_));
  return box;
}

std::optional<Contact> Cylinder::intersect(const Ray& world, double low, double high) const {
  const CenteredRay ray = pose_.to_local(world);
  NearestContact nearest(low, high);
  consider_wall(nearest, ray, radius_, half_, 0);
  consider_cap(nearest, ray, -half_, 0.0, radius_, 1);
  consider_cap(nearest, ray, half_, 0.0, radius_, 2);
  return nearest.best();
}

SurfacePoint Cylinder::surface_at(Vec3d x, std::uint32_t face) const {
  Vec3d local = pose_.to_local(x);
  if (face == 0) {
    const Vec3d out = away_from_axis(local);
    SurfacePoint point = pose_.point(out * radius_ + Vec3d{0, local.y, 0}, out);
    point.u = u_around(local);
    point.v = std::clamp(0.5 + 0.5 * local.y / half_, 0.0, 1.0);
    return point;
  }
  const double side = face == 1 ? -1.0 : 1.0;
  local.y = side * half_;
  SurfacePoint point = pose_.point(local, {0, side, 0});
  put_cap_coordinates(point, local, radius_, side);
  return point;
}

double Cylinder::clearance(const Segment& segment) const {
  return convex_clearance(SolidCylinder{radius_, half_}, pose_.to_local(segment.a),
                          pose_.to_local(segment.b));
}

double Cylinder::area() const { return 2.0 * std::numbers::pi * radius_ * (2.0 * half_ + radius_); }

SurfacePoint Cylinder::sample(double u1, double u2) const {
  const double wall = 2.0 * half_, cap = 0.5 * radius_;  // areas, over 2 pi r
  double at = u1 * (wall + 2.0 * cap);
  if (at < wall) return surface_at(pose_.to_world(around_axis(radius_, at - half_, u2)), 0);
  at -= wall;
  const std::uint32_t face = at < cap ? 1 : 2;
  const double share = std::min(1.0, (face == 1 ? at : at - cap) / cap);
  return surface_at(pose_.to_world(around_axis(radius_ * std::sqrt(share), 0.0, u2)), face);
}

std::vector<FlatFace> Cylinder::flat_faces() const {
  return {flat_cap(pose_, 1, -half_, radius_), flat_cap(pose_, 2, half_, radius_)};
}

}  // namespace portalens
