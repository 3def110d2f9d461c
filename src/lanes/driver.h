/// \file
/// Photons in lanes: 32 at a time in float take their steps together; what a step ends in, and
/// what lanes can't judge, is done one by one in double by the scalar engine.
#pragma once

#include <span>

#include "lanes/plan.h"
#include "photon/path_record.h"
#include "photon/photon.h"

namespace portalens {

struct Space;

/// @param records  of the first photons, each of which gets its path
/// @pre `step` is not null; `plan` was made from `space`
void advance_in_lanes(const Space& space, const LanePlan& plan, LaneStep step,
                      std::span<const Photon> photons, std::span<Arrival> arrivals,
                      std::span<PathRecord> records = {});

}  // namespace portalens
