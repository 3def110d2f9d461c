/// \file
/// Everything that decides where light goes: surfaces, portals, masses, and the physics.
#pragma once

#include <vector>

#include "geometry/accelerator.h"
#include "gravity/mass.h"
#include "photon/physics.h"
#include "portal/portal_set.h"

namespace portalens {

struct Space {
  Physics physics;
  std::uint32_t max_crossings = 16;
  Accelerator surfaces{std::vector<Shape>{}};
  PortalSet portals;
  std::vector<Mass> masses;
};

}  // namespace portalens
