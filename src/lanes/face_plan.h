/// \file
/// Laying out the faces of portals for the lanes.
#pragma once

#include <string>

#include "lanes/scene.h"
#include "portal/portal.h"

namespace portalens {

/// Half width and height of a portal that is a rectangle about its frame, else 0 and 0.
struct Rectangle {
  double half_width = 0.0, half_height = 0.0;
};

[[nodiscard]] Rectangle rectangle_of(const Portal& portal);

/// The smallest rectangle about its frame that holds a portal.
[[nodiscard]] Rectangle extent_of(const Portal& portal);

/// A portal's rim as lanes hold it.
struct FaceLayout {
  LaneOutline outline;
  std::string refusal;  ///< why lanes can't; empty where they can
};

[[nodiscard]] FaceLayout lay_out_face(const Portal& portal);

/// The largest distance from a place to a portal's corners.
[[nodiscard]] double farthest(const Portal& portal, Vec3d from);

/// Radius of a ball about the middle of a portal, out of which it does not act; with a slack beside
/// which a float's rounding is small.
[[nodiscard]] float ball_about(const Portal& portal, double reach, double extent);

/// A portal that is a rectangle, and acts within `reach`.
/// @param center  of the plan
/// @param extent  of the space
[[nodiscard]] LaneFace face_of(const Portal& portal, Vec3d center, double reach, double extent);

}  // namespace portalens
