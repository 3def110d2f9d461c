#include "geometry/sphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/closest_point.h"
#include "geometry/contacts.h"
#include "geometry/extent.h"

namespace portalens {

Sphere Sphere::from(Parameters& parameters) {
  const Vec3d center = to_vec3(parameters.triple("center"));
  const double radius = parameters.number("radius", positive);
  const Sphere sphere(center, radius);
  if (!extent_allowed(parameters, "radius", sphere.bounds(), radius)) return {{}, 1.0};
  return sphere;
}

Box Sphere::bounds() const {
  const Vec3d r{radius_, radius_, radius_};
  return {center_ - r, center_ + r};
}

/// Haines, Günther & Akenine-Möller, "Precision Improvements for Ray/Sphere Intersection": the
/// discriminant from the ray's point closest to the centre, the small root from the large one.
std::optional<Contact> Sphere::intersect(const Ray& ray, double low, double high) const {
  const Vec3d from = ray.origin - center_;
  const double b = dot(from, ray.direction);
  const Vec3d closest = from - ray.direction * b;
  const double square = radius_ * radius_ - dot(closest, closest);
  if (!(square >= -2.0 * radius_ * rounding_at(ray.origin, center_))) return std::nullopt;
  const double root = std::sqrt(std::max(0.0, square));
  const double c = (length(from) - radius_) * (length(from) + radius_);
  const double large = b < 0.0 ? root - b : -root - b;
  NearestContact nearest(low, high);
  nearest.consider(large, 0);
  nearest.consider(c / large, 0);
  return nearest.best();
}

SurfacePoint Sphere::surface_at(Vec3d x, std::uint32_t) const {
  const Vec3d away = x - center_;
  const double distance = length(away);
  const Vec3d normal = distance > 0.0 ? away / distance : Vec3d{0, 1, 0};
  SurfacePoint point;
  point.position = center_ + normal * radius_;
  point.normal = point.geometric_normal = normal;
  point.u = u_around(normal);
  point.v = 0.5 + std::asin(std::clamp(normal.y, -1.0, 1.0)) / std::numbers::pi;
  return point;
}

double Sphere::clearance(const Segment& segment) const {
  const double nearest = length(closest_on_segment(segment.a, segment.b, center_) - center_);
  const double farthest = std::max(length(segment.a - center_), length(segment.b - center_));
  return std::max({0.0, nearest - radius_, radius_ - farthest});
}

double Sphere::area() const { return 4.0 * std::numbers::pi * radius_ * radius_; }

namespace {

Vec3d uniform_direction(double u1, double u2) {
  const double y = 1.0 - 2.0 * u1;
  const double around = 2.0 * std::numbers::pi * u2;
  const double across = std::sqrt(std::max(0.0, 1.0 - y * y));
  return {across * std::sin(around), y, across * std::cos(around)};
}

}  // namespace

SurfacePoint Sphere::sample(double u1, double u2) const {
  return surface_at(center_ + uniform_direction(u1, u2) * radius_, 0);
}

/// From outside uniform in the cone of its silhouette, from inside in all directions.
SeenSurface Sphere::sample_seen(Vec3d x, double u1, double u2) const {
  const Vec3d way = center_ - x;
  const double distance = length(way), sine = radius_ / distance;
  if (!(sine < 1.0)) {
    const Vec3d direction = uniform_direction(u1, u2);
    const double towards = dot(way, direction);
    const double root =
        std::sqrt(std::max(0.0, radius_ * radius_ - distance * distance + towards * towards));
    return {surface_at(x + direction * (towards + root), 0), 4.0 * std::numbers::pi};
  }
  // 1 - cos of the cone's half angle, and of the direction's angle with the axis.
  const double of_cone = sine * sine / (1.0 + std::sqrt(1.0 - sine * sine)), off = u1 * of_cone;
  const double across = std::sqrt(off * (2.0 - off)), around = 2.0 * std::numbers::pi * u2;
  const Vec3d axis = way / distance, right = any_perpendicular(axis), up = cross(axis, right);
  const Vec3d direction =
      axis * (1.0 - off) + right * (across * std::cos(around)) + up * (across * std::sin(around));
  const double before =
      std::sqrt(std::max(0.0, radius_ * radius_ - distance * distance * across * across));
  return {surface_at(x + direction * (distance * (1.0 - off) - before), 0),
          2.0 * std::numbers::pi * of_cone};
}

}  // namespace portalens
