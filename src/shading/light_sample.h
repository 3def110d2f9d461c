/// \file
/// What all lights speak of. equations.md, sec. 7.
#pragma once

#include <algorithm>

#include "math/vec3.h"

namespace portalens {

/// One point of a light, as a place that it shines on sees it.
struct LightSample {
  Vec3d position;
  /// W/m², of a surface there that looks straight at the point, nothing being in the way: radiance
  /// over probability per solid angle, or intensity over the square of the distance.
  Rgb facing{};
  bool distant = false;  ///< it is infinitely far, and `position` the unit vector towards it

  [[nodiscard]] Vec3d way_from(Vec3d x) const { return distant ? position : position - x; }
};

/// Irradiance of a surface at `x` with unit normal `n`, from the sample that was drawn for `x`,
/// nothing being in the way.
[[nodiscard]] inline Rgb irradiance(const LightSample& sample, Vec3d x, Vec3d n) {
  const Vec3d way = sample.way_from(x);
  const double distance = length(way);
  if (!(distance > 0.0)) return {};
  return sample.facing * std::max(0.0, dot(n, way) / distance);
}

}  // namespace portalens
