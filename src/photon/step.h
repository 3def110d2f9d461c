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

/// By how much the parts of a step disagree, from which an adaptive integrator judges it.
template <class Real>
struct StepDoubt {
  Real uneven2{};  ///< square of its length times the cubic coefficient of dt/ds, radians²
  Real turn{};     ///< its length times its strongest bend, radians: about the most that it turns
  Real missed2{};  ///< square of the distance of its last node from the predicted place, length²
  Real turned2{};  ///< square of how far the direction there is from the predicted one, radians²
};

template <class Real>
struct StepResult {
  StateOf<Real> end;
  Real middle_bend{};       ///< |dt/ds| halfway, for the curve between
  StepDoubt<Real> doubt{};  ///< of adaptive integrators
};

/// The part of g/c² that turns a photon: dt/ds = (g - (g·t) t) / c². Dunigan & Pianta, sec. 5.
template <class Real>
[[nodiscard]] constexpr Vec3<Real> turning_part(Vec3<Real> acceleration, Vec3<Real> direction) {
  return subtract_product(acceleration, direction, dot(acceleration, direction));
}

}  // namespace portalens
