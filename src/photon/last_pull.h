/// \file
/// What is still to come of the turning of a photon that flies off from infinite influences.
#pragma once

#include <optional>

#include "gravity/field.h"
#include "photon/space.h"
#include "photon/step.h"

namespace portalens {

struct LastPull {
  double turning = 0.0;    ///< radians, from here to infinity
  double closeness = 0.0;  ///< Σ m/d of what pulls: the share by which `turning` may err
  Vec3d kick;              ///< what it adds to the direction
};

/// From here to infinity on a straight path, to first order in m/d. Nothing where that can't be
/// told: within a finite influence, on a path that does not lead outwards, or too near to portals.
/// @param surroundings  at the photon's place
/// @param through       what bends it there through portals
/// @param gates         the middle of all portals
[[nodiscard]] std::optional<LastPull> last_pull(const Space& space, const State& state,
                                                const Surroundings& surroundings, Vec3d through,
                                                Vec3d gates);

/// Of all their vertices; the origin if there are none.
[[nodiscard]] Vec3d middle_of_portals(const Space& space);

}  // namespace portalens
