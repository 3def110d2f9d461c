#include "geometry/round.h"

#include <numbers>

namespace portalens {

Vec3d around_axis(double radius, double height, double share) {
  const double angle = 2.0 * std::numbers::pi * share;
  return {radius * std::sin(angle), height, radius * std::cos(angle)};
}

void consider_wall(NearestContact& nearest, const CenteredRay& ray, double radius, double half,
                   std::uint32_t face) {
  const Vec3d &o = ray.origin, &d = ray.direction;
  const double a = d.x * d.x + d.z * d.z;
  const double b = o.x * d.x + o.z * d.z;
  const double c = (axis_distance(o) - radius) * (axis_distance(o) + radius);
  for (const double distance : roots(a, b, c, 2.0 * a * radius * ray.rounding)) {
    const double height = std::fabs(o.y + d.y * distance);
    if (within(height, half, std::fmax(half, radius)))
      nearest.consider(ray.offset + distance, face);
  }
}

void consider_cap(NearestContact& nearest, const CenteredRay& ray, double height, double inner,
                  double outer, std::uint32_t face) {
  const double distance = (height - ray.origin.y) / ray.direction.y;
  const double radius = axis_distance(ray.at(distance));
  const double size = std::fmax(outer, std::fabs(height));
  if (within(radius, outer, size) && within(inner, radius, size))
    nearest.consider(ray.offset + distance, face);
}

Vec3d SolidCylinder::closest(Vec3d p) const {
  const double distance = axis_distance(p);
  const double shrink = distance > radius ? radius / distance : 1.0;
  return {p.x * shrink, std::clamp(p.y, -half, half), p.z * shrink};
}

FlatFace flat_cap(const Pose& pose, std::uint32_t face, double height, double radius) {
  constexpr int corners = 8;
  const double reach = radius / std::cos(std::numbers::pi / corners);
  FlatFace flat{face, pose.turned({0, height < 0.0 ? -1.0 : 1.0, 0}), {}};
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    flat.hull.push_back(pose.to_world({reach * std::cos(angle), height, reach * std::sin(angle)}));
  }
  return flat;
}

}  // namespace portalens
