/// \file
/// How far a photon has come: what one engine hands to another.
#pragma once

#include "photon/drift.h"
#include "photon/obstacles.h"
#include "photon/photon.h"
#include "photon/step.h"

namespace portalens {

struct RayState {
  State state;
  PathStart start;
  Arrival arrival;  ///< length, turning, steps, crossings and tint so far
  Drift<double> drift;

  [[nodiscard]] static RayState of(const Photon& photon) {
    RayState ray_state;
    ray_state.state = {photon.position, photon.direction};
    ray_state.start.guard = photon.guard;
    return ray_state;
  }

  /// The arrival at the place where the path ends.
  [[nodiscard]] Arrival arrived() const {
    Arrival result = arrival;
    result.position = state.position;
    result.direction = state.direction;
    return result;
  }
};

}  // namespace portalens
