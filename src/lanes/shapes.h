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
  const PlaneBox box = box_of(portal.aperture);
  extent.half_width = std::max(std::fabs(box.low_x), std::fabs(box.high_x));
  extent.half_height = std::max(std::fabs(box.low_y), std::fabs(box.high_y));
  return extent;
}

/// @pre a polygon of no more edges than `max_lane_edges`, or an ellipse
[[nodiscard]] inline LaneOutline outline_of(const Portal& portal) {
  LaneOutline outline{};
  if (const auto* ellipse = std::get_if<Ellipse>(&portal.aperture)) {
    outline.kind = LaneOutline::Kind::ellipse;
    outline.per_x = static_cast<float>(1.0 / ellipse->a());
    outline.per_y = static_cast<float>(1.0 / ellipse->b());
    return outline;
  }
  const PortalFace face(portal);
  const std::vector<FaceEdge>& edges = face.edges();
  outline.longest = static_cast<float>(portal.longest_edge);
  if (!face.is_convex_polygon()) outline.kind = LaneOutline::Kind::simple;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const FaceEdge &edge = edges[i], &next = edges[(i + 1) % edges.size()];
    const FaceEdge& last = edges[(i + edges.size() - 1) % edges.size()];
    const double begin = edge.start_x * edge.direction_x + edge.start_y * edge.direction_y;
    const double turn = last.direction_x * edge.direction_y - last.direction_y * edge.direction_x;
    outline.edges[outline.count++] = {static_cast<float>(edge.direction_x),
                                      static_cast<float>(edge.direction_y),
                                      static_cast<float>(begin),
                                      static_cast<float>(edge.length),
                                      static_cast<float>(-edge.outside(0.0, 0.0)),
                                      static_cast<float>(edge.start_y),
                                      static_cast<float>(next.start_y),
                                      turn < 0.0 ? 1.0f : 0.0f};
  }
  return outline;
}

}  // namespace portalens
