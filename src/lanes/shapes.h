/// \file
/// From doubles to what lanes hold.
#pragma once

#include <algorithm>
#include <cmath>

#include "gravity/portal_face.h"
#include "lanes/scene.h"
#include "portal/portal.h"

namespace portalens {

[[nodiscard]] inline LaneVec narrow(Vec3d v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// `LaneMass::bare2` of a mass without a horizon: light that comes nearer to a point than m never
/// leaves it.
[[nodiscard]] inline float bare2_of(float gm, float core2) {
  return core2 < gm * gm ? gm * gm : 0.0f;
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

/// The smallest rectangle about its frame that holds a portal.
[[nodiscard]] inline Rectangle extent_of(const Portal& portal) {
  Rectangle extent = rectangle_of(portal);
  if (extent.half_width > 0.0) return extent;
  for (const Vec3d& vertex : portal.vertices) {
    const Vec3d local = portal.frame.to_local(vertex);
    extent.half_width = std::max(extent.half_width, std::fabs(local.x));
    extent.half_height = std::max(extent.half_height, std::fabs(local.y));
  }
  return extent;
}

/// @pre no more vertices than `max_lane_edges`
[[nodiscard]] inline LaneOutline outline_of(const Portal& portal) {
  LaneOutline outline{};
  const PortalFace face(portal);
  for (const FaceEdge& edge : face.edges()) {
    const double begin = edge.start_x * edge.direction_x + edge.start_y * edge.direction_y;
    outline.edges[outline.count++] = {static_cast<float>(edge.direction_x),
                                      static_cast<float>(edge.direction_y),
                                      static_cast<float>(begin), static_cast<float>(edge.length),
                                      static_cast<float>(-edge.outside(0.0, 0.0))};
  }
  return outline;
}

}  // namespace portalens
