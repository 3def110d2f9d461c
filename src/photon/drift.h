/// \file
/// How far a path may have drifted from the true one.
#pragma once

#include <cmath>

#include "math/multiply_add.h"
#include "photon/photon.h"

namespace portalens {

/// What the errors of a path's steps have come to: an estimate on the safe side. A step that begins
/// beside its place finds another field there, which turns it by so much more; what has turned
/// leads further from its place:
///     d(direction)/ds = |∇a| place + errors,    d(place)/ds = direction,
/// of ∇a what counts across the path (`BendingOf::shear`).
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
inline constexpr double trusted_drift = 8.0;

/// The drift in lanes, radians, above which a path is taken again: there in finer steps, then by
/// the scalar engine. The drift overestimates the error of many steps about one mass, but hardly
/// that of a few steps whose errors further masses magnify. Of paths that had drifted by 20 to 40
/// tolerances of 1e-4, 1 of 14 was off by more than one tolerance about up to 3 masses, and nearly
/// 1 of 2 about 4 to 12. With finer steps, too, the drift is nearer to the error.
[[nodiscard]] inline double trusted_drift_in_lanes(int masses, double tolerance) {
  const double tolerances = masses > 3 ? 10.0 : 40.0;
  return tolerances * tolerance * std::sqrt(std::fmin(tolerance / 1e-4, 1.0));
}

/// So far a path that ends in a horizon may drift, radians: it is asked for no direction.
inline constexpr double absorbed_drift = 0.1;

/// Whether a photon's path in finer steps ends as the one in coarser steps did: then it is trusted,
/// however far it may have drifted. The estimate of the drift takes every pull for one that leads
/// neighbours apart; gravity through a portal, which does not fall off, may hold them together for
/// as long as it acts. Paths of hardly more steps err alike, and tell nothing.
[[nodiscard]] inline bool end_alike(const Arrival& coarser, const Arrival& finer,
                                    double tolerance) {
  constexpr double share = 0.1;  // of the tolerance
  constexpr double more_steps = 1.2;
  if (finer.fate != coarser.fate || finer.met != coarser.met || finer.object != coarser.object ||
      finer.crossings != coarser.crossings || !(finer.steps > more_steps * coarser.steps))
    return false;
  const bool tells_direction = finer.fate == Fate::hit || finer.fate == Fate::escaped;
  return !tells_direction || length(finer.direction - coarser.direction) <= share * tolerance;
}

}  // namespace portalens
