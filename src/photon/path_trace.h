/// \file
/// What a curious caller can be told of one photon's path (`trace --path`).
#pragma once

#include <cstdint>
#include <vector>

#include "math/vec3.h"

namespace portalens {

struct PathTrace {
  std::vector<std::vector<Vec3d>> stretches{{}};  ///< one polyline between portal crossings
  std::vector<std::uint32_t> crossings;           ///< the portals entered, in order
};

}  // namespace portalens
