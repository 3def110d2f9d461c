/// \file
/// How far a path may have drifted from the true one.
#pragma once

#include "math/multiply_add.h"

namespace portalens {

/// What the errors of a path's steps have come to: an estimate on the safe side. A step that begins
/// beside its place finds another field there, which turns it by so much more; what has turned
/// leads further from its place:
///     d(direction)/ds = |∇a| place + errors,    d(place)/ds = direction.
template <class Real>
struct Drift {
  Real place{}, direction{};  ///< length, and radians

  /// Over a step or a flight.
  /// @param gradient  of the acceleration over c², 1/length²
  /// @param error     by which the step itself may err, radians
  void pass(Real length, Real gradient, Real error) {
    direction = multiply_add(gradient * length, place, direction + error);
    place = multiply_add(direction, length, place);
  }
};

/// A path that has drifted by more tolerances than that is taken again, in finer steps. Nearly all
/// drift by far less than they may. Measured on random scenes (docs/differential.md).
inline constexpr double trusted_drift = 20.0;

/// A path that has drifted by more than that in lanes is taken again there in finer steps, and then
/// by the scalar engine; radians. At fine tolerances more of the drift is rounding, which an
/// estimate of a step's error does not tell from luck.
[[nodiscard]] constexpr double trusted_drift_in_lanes(double tolerance) {
  return 70.0 * tolerance * (tolerance < 1e-4 ? tolerance / 1e-4 : 1.0);
}

/// So far a path that ends in a horizon may drift, radians: it is asked for no direction.
inline constexpr double absorbed_drift = 0.1;

}  // namespace portalens
