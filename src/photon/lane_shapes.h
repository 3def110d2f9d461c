/// \file
/// From doubles to what lanes hold.
#pragma once

#include "photon/lane_scene.h"
#include "portal/portal.h"

namespace portalens {

[[nodiscard]] inline LaneVec narrow(Vec3d v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// Half width and height of a portal that is a rectangle about its frame, else 0 and 0.
struct Rectangle {
  double half_width = 0.0, half_height = 0.0;
};

[[nodiscard]] inline Rectangle rectangle_of(const Portal& portal) {
  if (portal.vertices.size() != 4) return {};
  const Vec3d corner = portal.frame.to_local(portal.vertices[2]);
  const Vec3d expected[4] = {{-corner.x, -corner.y, 0},
                             {corner.x, -corner.y, 0},
                             {corner.x, corner.y, 0},
                             {-corner.x, corner.y, 0}};
  for (int i = 0; i < 4; ++i)
    if (length(portal.frame.to_local(portal.vertices[i]) - expected[i]) >
        1e-9 * portal.longest_edge)
      return {};
  return {corner.x, corner.y};
}

}  // namespace portalens
