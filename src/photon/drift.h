/// \file
/// How far a way may have drifted from the true one.
#pragma once

#include "math/multiply_add.h"

namespace portalens {

/// What the errors of a way's steps have come to: an estimate on the safe side. A step that begins
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

/// A way that has drifted by more tolerances than that is taken again, in finer steps; and of one
/// that has drifted by more in lanes, the scalar engine is asked. Nearly all drift by far less than
/// they may. Measured on random scenes (docs/differential.md).
inline constexpr double trusted_drift = 40.0, trusted_drift_in_lanes = 150.0;

}  // namespace portalens
