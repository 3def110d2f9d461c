/// \file
/// Spaces in which a law of one's choice bends light.
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "gravity/law.h"
#include "support/lanes.h"
#include "support/spaces.h"

namespace portalens::test {

inline Physics physics_of(std::string_view law, double tolerance, double min_force) {
  Physics physics = physics_with(tolerance, min_force);
  physics.law = law;
  physics.max_length = 1e9;
  return physics;
}

inline PlannedSpace space_of(const Physics& physics, std::vector<Mass> masses,
                             std::vector<Shape> shapes = {}, std::vector<Portal> portals = {}) {
  set_horizons(make_law(physics.law), masses, physics.c);
  return space_with(physics, std::move(masses), std::move(shapes), std::move(portals));
}

/// One hole in the origin, like that of equations.md, sec. 3.
inline PlannedSpace standard_hole(std::string_view law, double tolerance) {
  const Physics physics = physics_of(law, tolerance, 0.01);
  return space_of(physics, {mass_at({0, 0, 0}, standard_gm, physics)});
}

/// G M / c² of that hole.
inline constexpr double m = standard_gm / (45.0 * 45.0);

}  // namespace portalens::test
