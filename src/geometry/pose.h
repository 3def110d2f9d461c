/// \file
/// Where a solid stands: its own coordinates have their origin in the middle of its box, and are
/// turned about it by the degrees of its `rotation` (x first, then y, then z).
#pragma once

#include "geometry/contacts.h"
#include "math/rigid.h"

namespace portalens {

class Pose {
 public:
  Pose(Vec3d middle, Vec3d degrees) : motion_(rotation_about({0, 0, 0}, degrees)) {
    motion_.to = middle;
  }

  [[nodiscard]] Vec3d middle() const { return motion_.to; }
  [[nodiscard]] Vec3d to_local(Vec3d point) const { return motion_.move_back(point); }
  [[nodiscard]] Vec3d to_world(Vec3d local) const { return motion_.move(local); }
  [[nodiscard]] CenteredRay to_local(const Ray& ray) const {
    return {to_local(ray.origin), motion_.rotate_back(ray.direction),
            rounding_at(ray.origin, middle())};
  }
  /// A direction of the solid's own coordinates, in the world's.
  [[nodiscard]] Vec3d turned(Vec3d local_direction) const {
    return motion_.rotate(local_direction);
  }
  /// The world box of a disc of this radius about the y axis, at this height.
  [[nodiscard]] Box disc(double height, double radius) const {
    const Vec3d axis = turned({0, 1, 0}), middle = to_world({0, height, 0});
    const auto half = [&](double c) { return radius * std::sqrt(std::fmax(0.0, 1.0 - c * c)); };
    const Vec3d reach{half(axis.x), half(axis.y), half(axis.z)};
    return {middle - reach, middle + reach};
  }
  /// The surface point at `local` with that outward normal; texture coordinates are left at 0.
  [[nodiscard]] SurfacePoint point(Vec3d local, Vec3d local_normal) const {
    SurfacePoint point;
    point.position = to_world(local);
    point.normal = point.geometric_normal = turned(local_normal);
    return point;
  }

 private:
  Rigid motion_;
};

}  // namespace portalens
