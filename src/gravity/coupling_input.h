/// \file
/// What every coupling is made from, and what it answers.
#pragma once

#include <cstdint>
#include <span>

#include "gravity/mass.h"
#include "portal/portal.h"

namespace portalens {

struct CouplingInput {
  std::span<const Portal> portals;
  std::span<const Mass> masses;  ///< massive portals among them
  double min_force = 0.01;       ///< f, length/time²
  int depth = 1;                 ///< portals in a row, >= 0; 0 = none
  int graviton_resolution = 32;  ///< nodes along a portal's longer side, >= 2
};

/// An acceleration, and how sharply it varies, from which the step is chosen: the sums over its
/// sources of G M / d⁵ and of 1 / d⁴ (d with the core; any other length over which the field varies
/// counts as a d).
struct Pull {
  Vec3d acceleration;
  double stiffness = 0.0;
  double nearness = 0.0;

  Pull& operator+=(const Pull& other) {
    acceleration += other.acceleration;
    stiffness += other.stiffness;
    nearness += other.nearness;
    return *this;
  }
};

}  // namespace portalens
