/// \file
/// What every integrator's step starts from and gives back.
#pragma once

#include "math/multiply_add.h"

namespace portalens {

/// A photon between two steps. `direction` is a unit vector.
template <class Real>
struct StateOf {
  Vec3<Real> position, direction;
};
using State = StateOf<double>;

template <class Real>
struct StepResult {
  StateOf<Real> end;
  Real middle_bend{};  ///< |dt/ds| halfway, for the curve between
};

/// The part of g/c² that turns a photon: dt/ds = (g - (g·t) t) / c². Dunigan & Pianta, sec. 5.
template <class Real>
[[nodiscard]] constexpr Vec3<Real> turning_part(Vec3<Real> acceleration, Vec3<Real> direction) {
  return subtract_product(acceleration, direction, dot(acceleration, direction));
}

}  // namespace portalens
