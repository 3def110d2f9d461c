/// \file
/// A flat face of a shape, as a place that spans it.
#pragma once

#include <cstdint>
#include <vector>

#include "math/vec3.h"

namespace portalens {

struct FlatFace {
  std::uint32_t face = 0;
  Vec3d normal;             ///< unit, as `surface_at` tells it
  std::vector<Vec3d> hull;  ///< a convex polygon that just holds it; in its plane
};

}  // namespace portalens
