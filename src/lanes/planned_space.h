/// \file
/// A space together with the lanes' plan of it: what photons are advanced in.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lanes/plan.h"
#include "photon/space.h"

namespace portalens {

/// Immutable once made; safe from any thread.
struct PlannedSpace : Space {
  /// @param viewpoint  as of a `Space`
  PlannedSpace(Physics physics, std::uint32_t max_crossings, std::vector<Shape> shapes,
               std::vector<Portal> portals, std::vector<Mass> masses,
               std::optional<Vec3d> viewpoint = std::nullopt);

  std::unique_ptr<const LanePlan> lanes;  ///< null where lanes can't do it
  std::string no_lanes_because;           ///< why that is so (LaneChoice); empty where they can
};

}  // namespace portalens
