/// \file
/// For paths that lanes hand over to the scalar engine within a step: what a float's rounding has
/// put behind a portal that lanes have not seen it cross. In double it would be past the portal,
/// and never cross it.
#pragma once

#include <cmath>

#include "lanes/scene.h"
#include "photon/space.h"
#include "photon/step.h"

namespace portalens {

/// Where the path is, by the rule by which lanes find crossings (lanes/meetings.h): a place that is
/// no further behind a portal than its `tolerance` counts as in front of it.
/// @param departed  `Lanes::departed` of the path
[[nodiscard]] inline Vec3d before_portals(const Space& space, const LaneScene& scene,
                                          const State& state, float departed) {
  Vec3d place = state.position;
  for (int p = 0; p < scene.portal_count; ++p) {
    const LanePortal& lane = scene.portals[p];
    const Frame& frame = space.portals.portals()[static_cast<std::size_t>(p)].frame;
    if (departed == lane.leaves || dot(state.direction, frame.normal) >= 0.0) continue;
    const double height = dot(place - frame.origin, frame.normal);
    if (height <= 0.0 && height >= -static_cast<double>(lane.tolerance))
      place -= frame.normal * height;
  }
  return place;
}

/// From which side light in that state meets a portal.
[[nodiscard]] inline PortalSide side_met(const Portal& portal, const State& state) {
  return dot(state.direction, portal.frame.normal) < 0.0 ? PortalSide::front : PortalSide::back;
}

/// Where a path that has come to a portal's plane is on it: along the path.
[[nodiscard]] inline Vec3d onto_plane(const Portal& portal, const State& state) {
  const double slope = dot(state.direction, portal.frame.normal);
  if (!(std::fabs(slope) > 1e-6)) return state.position;
  const double height = dot(state.position - portal.frame.origin, portal.frame.normal);
  return state.position - state.direction * (height / slope);
}

}  // namespace portalens
