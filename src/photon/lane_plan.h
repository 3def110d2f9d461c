/// \file
/// Laying out a space for the lanes.
#pragma once

#include <memory>
#include <vector>

#include "math/vec3.h"
#include "photon/lane_scene.h"

namespace portalens {

struct Space;

/// The scene in floats about `center`.
struct LanePlan {
  LaneScene scene;
  Vec3d center;
  std::vector<float> map_nodes, map_cells;  ///< that `scene.maps` look up

  LanePlan() = default;
  LanePlan(const LanePlan&) = delete;
  LanePlan& operator=(const LanePlan&) = delete;
};

/// Null where lanes can't do it: a fixed-step integrator, infinite influences, portals that are no
/// rectangles, `shortest-path` through more than one portal, or more masses, portals, chains or
/// ways than the lanes have room for. The scalar engine does all of that.
[[nodiscard]] std::unique_ptr<const LanePlan> plan_lanes(const Space& space);

}  // namespace portalens
