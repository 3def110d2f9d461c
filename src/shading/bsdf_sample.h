/// \file
/// What all BSDFs speak of.
#pragma once

#include <cmath>

#include "math/vec3.h"

namespace portalens {

/// A direction that light comes from. Of its radiance `color * weight` is reflected, which is
/// value cos / (pi density) of what was sampled.
struct BsdfSample {
  Vec3d direction;  ///< unit, away from the surface
  Rgb color;
  double weight = 1.0;   ///< 0 to 1
  double density = 0.0;  ///< of such directions, per solid angle, where `glossy` tells them, too
};

/// What a BSDF tells of a pair of directions whose light photons find, too.
struct Glossy {
  Rgb value;             ///< the reflectance factor: pi times the BRDF
  double density = 0.0;  ///< with which `sample` draws the one that light comes from
};

/// One comparison in place of three.
[[nodiscard]] inline bool is_black(Rgb light) {
  return std::fabs(light.x) + std::fabs(light.y) + std::fabs(light.z) == 0.0;
}

}  // namespace portalens
