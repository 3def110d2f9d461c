/// \file
/// From doubles to what lanes hold.
#pragma once

#include "lanes/scene.h"
#include "math/vec3.h"

namespace portalens {

[[nodiscard]] inline LaneVec narrow(Vec3d v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// `LaneMass::bare2` of a mass without a horizon: light that comes nearer to a point than m never
/// leaves it.
[[nodiscard]] inline float bare2_of(float gm, float core2) {
  return core2 < gm * gm ? gm * gm : 0.0f;
}

}  // namespace portalens
