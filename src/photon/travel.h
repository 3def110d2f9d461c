/// \file
/// How far a photon has come: what one engine hands to another.
#pragma once

#include "photon/drift.h"
#include "photon/obstacles.h"
#include "photon/photon.h"
#include "photon/step.h"

namespace portalens {

struct Travel {
  State state;
  PathStart start;
  Arrival arrival;  ///< length, turning, steps, crossings and tint so far
  Drift<double> drift;

  [[nodiscard]] static Travel of(const Photon& photon) {
    Travel travel;
    travel.state = {photon.position, photon.direction};
    travel.start.departure = photon.departure;
    return travel;
  }

  /// The arrival at the place where the way ends.
  [[nodiscard]] Arrival arrived() const {
    Arrival result = arrival;
    result.position = state.position;
    result.direction = state.direction;
    return result;
  }
};

}  // namespace portalens
