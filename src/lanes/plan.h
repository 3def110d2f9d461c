/// \file
/// Laying out a space for the lanes.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "lanes/isolated_masses.h"
#include "lanes/mass_grid.h"
#include "lanes/scene.h"
#include "math/vec3.h"

namespace portalens {

struct Space;

/// The scene in floats about `center`.
struct LanePlan {
  LaneScene scene;
  Vec3d center;
  std::vector<float> map_nodes, map_cells;  ///< that `scene.maps` look up
  IsolatedMasses isolated;                  ///< that `scene.isolated` are
  /// The masses that `scene.masses` begin with, or those that `scene.many` holds.
  std::vector<std::uint32_t> stepped;
  MassGrid many;           ///< that `scene.many` looks into
  double max_drift = 0.0;  ///< of a path that is trusted, radians; by its `LaneStrictness` more
  /// The shapes that `scene.boxes` hold.
  std::vector<std::uint32_t> boxed;

  LanePlan() = default;
  LanePlan(const LanePlan&) = delete;
  LanePlan& operator=(const LanePlan&) = delete;

  /// The mass of the space that is the `object` of an event.
  [[nodiscard]] std::uint32_t mass_of(std::uint32_t object) const {
    if (is_isolated(object)) return isolated.masses[object - first_isolated_object].mass;
    return stepped[object < first_isolated_object ? object : object - first_many_object];
  }
  /// What lanes have `departed` from, if it is a plane that `FlushFaces` tells.
  [[nodiscard]] static float departed_from(std::uint32_t plane) {
    return static_cast<float>(first_departed_plane - static_cast<int>(plane));
  }
  /// Whether that is one which is alone.
  [[nodiscard]] static bool is_isolated(std::uint32_t object) {
    return object >= first_isolated_object && object < first_many_object;
  }
};

/// What lanes do about a space.
struct LaneChoice {
  std::unique_ptr<const LanePlan> plan;  ///< null where they leave it to the scalar engine
  /// Then why: what the scene has, and what lanes would take. No capital letter, no full stop.
  std::string refusal;
};

/// Lanes leave to the scalar engine: a fixed-step integrator, a tolerance below 1e-5, infinite
/// influences, masses or portals so far from each other that floats can't place them, lengths whose
/// powers floats can't hold, portals of more edges than `max_lane_edges`, `closest-point` through
/// ellipses in a row, `shortest-path` through one or through more than one portal, laws that are
/// not uniform where anything acts through portals or more than `max_lane_masses`
/// act, or more masses, portals, chains or paths than they have room for: of masses that are not
/// alone `max_lane_masses` where a coupling looks at each through portals, else `max_lane_many`.
/// docs/see-why.md lists the reasons as they are printed, and what to change.
[[nodiscard]] LaneChoice plan_lanes(const Space& space);

}  // namespace portalens
