/// \file
/// What all lights speak of. equations.md, sec. 7.
#pragma once

#include <cmath>

#include "math/vec3.h"

namespace portalens {

/// Which sides of a light shine; `everywhere` is a point's.
enum class Shining { everywhere, both_sides, back_only };

/// One point of a light, as a surface that it shines on sees it.
/// Irradiance of a surface at distance d under the angle θ, before anything is in the way:
/// `power · cos θ / d²`, for a light with a surface times |cos| of the angle at the light.
struct LightSample {
  Vec3d position;
  Vec3d normal;  ///< unit; of no meaning for a point light
  Rgb power;     ///< W/sr: intensity of a point; radiance over probability per area of a surface
  Shining shining = Shining::everywhere;
};

/// Irradiance of a surface at `x` with unit normal `n`, from this sample, nothing being in the way.
[[nodiscard]] inline Rgb irradiance(const LightSample& sample, Vec3d x, Vec3d n) {
  const Vec3d way = sample.position - x;
  const double distance = length(way);
  if (!(distance > 0.0)) return {};
  const double here = dot(n, way) / distance;
  if (!(here > 0.0)) return {};
  double there = 1.0;
  if (sample.shining != Shining::everywhere) there = dot(sample.normal, way) / distance;
  if (sample.shining == Shining::both_sides) there = std::fabs(there);
  if (!(there > 0.0)) return {};
  return sample.power * (here * there / (distance * distance));
}

}  // namespace portalens
