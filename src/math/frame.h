/// \file
/// A right-handed orthonormal frame: an origin and three directions.
#pragma once

#include "math/vec3.h"

namespace portalens {

/// `right`, `up`, `normal` are orthonormal and `normal = right × up`.
template <class Real>
struct FrameOf {
  Vec3<Real> origin, right, up, normal;

  [[nodiscard]] constexpr Vec3<Real> to_local(Vec3<Real> point) const {
    return direction_to_local(point - origin);
  }
  [[nodiscard]] constexpr Vec3<Real> direction_to_local(Vec3<Real> d) const {
    return {dot(d, right), dot(d, up), dot(d, normal)};
  }
  [[nodiscard]] constexpr Vec3<Real> to_world(Vec3<Real> local) const {
    return origin + direction_to_world(local);
  }
  [[nodiscard]] constexpr Vec3<Real> direction_to_world(Vec3<Real> d) const {
    return right * d.x + up * d.y + normal * d.z;
  }
};

using Frame = FrameOf<double>;

}  // namespace portalens
