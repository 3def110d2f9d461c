/// \file
/// Laying out a space for the lanes.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "math/vec3.h"
#include "photon/lane_scene.h"
#include "photon/lone_masses.h"

namespace portalens {

struct Space;

/// The scene in floats about `center`.
struct LanePlan {
  LaneScene scene;
  Vec3d center;
  std::vector<float> map_nodes, map_cells;  ///< that `scene.maps` look up
  LoneMasses lone;                          ///< that `scene.lone` are
  std::vector<std::uint32_t> stepped;       ///< the masses that `scene.masses` begin with

  LanePlan() = default;
  LanePlan(const LanePlan&) = delete;
  LanePlan& operator=(const LanePlan&) = delete;

  /// The mass of the space that is the `object` of an event.
  [[nodiscard]] std::uint32_t mass_of(std::uint32_t object) const {
    return object < most_lane_masses ? stepped[object]
                                     : lone.masses[object - most_lane_masses].mass;
  }
};

/// Null where lanes can't do it: a fixed-step integrator, infinite influences, portals of
/// more edges than `most_lane_edges`, `graviton-map` and `shortest-path` through any that is no
/// rectangle, `shortest-path` through more than one portal, or more masses that are not alone,
/// portals, chains or ways than the lanes have room for. The scalar engine does all of that.
[[nodiscard]] std::unique_ptr<const LanePlan> plan_lanes(const Space& space);

}  // namespace portalens
