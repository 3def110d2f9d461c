/// \file
/// A space together with the lanes' plan of it: what photons are advanced in.
#pragma once

#include <memory>
#include <string>

#include "lanes/plan.h"
#include "photon/space.h"

namespace portalens {

/// Immutable once made; safe from any thread.
struct PlannedSpace : Space {
  explicit PlannedSpace(Space space);

  std::unique_ptr<const LanePlan> lanes;  ///< null where lanes can't do it
  std::string no_lanes_because;           ///< why that is so (LaneChoice); empty where they can
};

}  // namespace portalens
