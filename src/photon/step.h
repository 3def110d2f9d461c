/// \file
/// What every integrator's step starts from and gives back.
#pragma once

#include "math/vec3.h"

namespace portalens {

/// A photon between two steps. `direction` is a unit vector.
struct State {
  Vec3d position, direction;
};

struct StepResult {
  State end;
  double middle_bend = 0.0;  ///< |dt/ds| halfway, for the curve between
};

/// The part of g/c² that turns a photon: dt/ds = (g - (g·t) t) / c². Dunigan & Pianta, sec. 5.
[[nodiscard]] constexpr Vec3d turning_part(Vec3d acceleration, Vec3d direction) {
  return acceleration - direction * dot(acceleration, direction);
}

}  // namespace portalens
