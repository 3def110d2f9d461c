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
  Real uneven2{};  ///< square of what the field along it has of the third order, radians²
  Real turn{};     ///< the most that it turns by, were its strongest bend to last, radians
  Real missed2{};  ///< of how far its last node lies from the place foreseen for it, length²
  Real turned2{};  ///< and its direction from that which was foreseen, radians²
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
