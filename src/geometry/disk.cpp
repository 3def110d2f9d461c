#include "geometry/disk.h"

#include <cmath>
#include <numbers>

#include "geometry/clearance.h"

namespace portalens {

Disk::Disk(Vec3d center, Vec3d normal, double radius)
    : center_(center),
      normal_(normal),
      right_(any_perpendicular(normal)),
      up_(cross(normal, right_)),
      radius_(radius) {}

/// Along an axis it reaches as far as the sine of the angle between that and its normal.
Box Disk::bounds() const {
  const auto reach = [&](double cosine) {
    return radius_ * std::sqrt(std::fmax(0.0, 1.0 - cosine * cosine));
  };
  const Vec3d half{reach(normal_.x), reach(normal_.y), reach(normal_.z)};
  Box box;
  box.add(center_ - half);
  box.add(center_ + half);
  return box;
}

std::optional<Contact> Disk::intersect(const Ray& ray, double low, double high) const {
  const double distance = dot(center_ - ray.origin, normal_) / dot(ray.direction, normal_);
  if (!(distance >= low && distance <= high)) return std::nullopt;
  const Vec3d off = ray.origin + ray.direction * distance - center_;
  if (!(dot(off, off) <= radius_ * radius_)) return std::nullopt;
  return Contact{distance, 0};
}

SurfacePoint Disk::surface_at(Vec3d x, std::uint32_t) const {
  const Vec3d off = x - center_;
  SurfacePoint point;
  point.position = x - normal_ * dot(off, normal_);
  point.normal = point.geometric_normal = normal_;
  point.flat = true;
  point.along = dot(off, right_) + radius_;
  point.across = dot(off, up_) + radius_;
  point.u = point.along / (2.0 * radius_);
  point.v = point.across / (2.0 * radius_);
  return point;
}

double Disk::clearance(const Segment& segment) const {
  const auto approach = [&](Vec3d from, Vec3d way) {
    const Vec3d off = from - center_, flat = off - normal_ * dot(off, normal_);
    const double distance = length(flat);
    const double shrink = distance > radius_ ? radius_ / distance : 1.0;
    return Approach::to(center_ + flat * shrink, from, way);
  };
  const double height_a = dot(segment.a - center_, normal_);
  const double height_b = dot(segment.b - center_, normal_);
  const double plane =
      height_a * height_b > 0.0 ? std::fmin(std::fabs(height_a), std::fabs(height_b)) : 0.0;
  const Vec3d way = segment.b - segment.a;
  return std::fmax(plane, least_between(approach(segment.a, way), approach(segment.b, way)));
}

double Disk::area() const { return std::numbers::pi * radius_ * radius_; }

SurfacePoint Disk::sample(double u1, double u2) const {
  const double distance = radius_ * std::sqrt(u1), around = 2.0 * std::numbers::pi * u2;
  return surface_at(center_ + (right_ * std::cos(around) + up_ * std::sin(around)) * distance, 0);
}

std::vector<FlatFace> Disk::flat_faces() const { return {{0, normal_, hull()}}; }

std::vector<Vec3d> Disk::hull() const {
  constexpr int corners = 16;
  const double reach = radius_ / std::cos(std::numbers::pi / corners);
  std::vector<Vec3d> polygon;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    polygon.push_back(center_ + (right_ * std::cos(angle) + up_ * std::sin(angle)) * reach);
  }
  return polygon;
}

}  // namespace portalens
