/// \file
/// What a coupling's pull consists of, for people who want to look.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "math/vec3.h"

namespace portalens {

/// One way through portals, and what it adds to the pull at a point. What the places are, each
/// coupling says at its `parts`.
struct PullPart {
  std::vector<std::uint32_t> portals;  ///< entered one after the other
  std::optional<std::uint32_t> mass;   ///< what pulls, if it is one mass alone
  Vec3d acceleration;                  ///< as it is felt at the point
  Vec3d entrance;                      ///< on the face of the first portal
  std::vector<Vec3d> places;           ///< where the path touches faces
  Vec3d beyond;                        ///< where it leads to
  double distance = 0.0;               ///< how long it is
};

}  // namespace portalens
