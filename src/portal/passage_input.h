/// \file
/// What every passage is made from, and what it answers.
#pragma once

#include "math/vec3.h"
#include "portal/face_input.h"

namespace portalens {

/// The two faces of a pair: light goes into the first and comes out of the second.
struct PassageInput {
  const FaceInput &from, &to;
};

/// Where light comes out again, and the direction it then has, a unit vector.
struct Passed {
  Vec3d position, direction;
  /// By how much its path turned within, radians: it counts towards `physics.max_turning`.
  double turning;
};

}  // namespace portalens
