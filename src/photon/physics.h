/// \file
/// The constants of a scene's physics, and how exactly photons follow it: the `[physics]` table.
#pragma once

#include <cstdint>
#include <string>

#include "core/parameters.h"

namespace portalens {

struct Physics {
  double G = 1.0;
  double c = 45.0;
  double min_force = 0.01;
  std::string law = "newton";
  std::string integrator = "adaptive";
  double tolerance = 1e-4;  ///< radians in direction, over a path
  double step = 0.02;       ///< fixed-step integrators, arc length
  std::int64_t max_steps = 20000;
  double max_length = 1e6;
  double max_turning = 25.132741228718345;
  std::string portal_gravity = "closest-point";
  std::int64_t portal_gravity_depth = 1;
  std::int64_t graviton_resolution = 32;

  static Physics from(Parameters& parameters);
};

}  // namespace portalens
