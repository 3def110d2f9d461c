/// \file
/// Photons in lanes: 32 at a time in float take their steps together; what a step ends in, and
/// what lanes can't judge, is done one by one in double by the scalar engine.
#pragma once

#include <span>

#include "photon/lane_plan.h"
#include "photon/photon.h"
#include "photon/trail.h"

namespace portalens {

struct Space;

/// @param trails  of the first photons, each of which gets its way
/// @pre `step` is not null; `plan` was made from `space`
void advance_in_lanes(const Space& space, const LanePlan& plan, LaneStep step,
                      std::span<const Photon> photons, std::span<Arrival> arrivals,
                      std::span<Trail> trails = {});

}  // namespace portalens
