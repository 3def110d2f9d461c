/// \file
/// Everything that decides where light goes: surfaces, portals, masses, and the physics.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/accelerator.h"
#include "gravity/coupling.h"
#include "gravity/law.h"
#include "gravity/mass.h"
#include "gravity/mass_tree.h"
#include "photon/physics.h"
#include "portal/portal_set.h"

namespace portalens {

/// Immutable once made; safe from any thread.
struct Space {
  Space(Physics physics, std::uint32_t max_crossings, std::vector<Shape> shapes,
        std::vector<Portal> portals, std::vector<Mass> masses,
        std::optional<Vec3d> viewpoint = std::nullopt);

  /// How a path leaves the plane of a portal, over its front or its back as `direction` says.
  [[nodiscard]] SelfIntersectionGuard leaving_portal(std::uint32_t index, Vec3d position,
                                                     Vec3d direction) const;

  Physics physics;
  Law law;
  LawConstants medium;  ///< of the law
  std::uint32_t max_crossings;
  Accelerator surfaces;
  PortalSet portals;
  std::vector<Portal> mouths;  ///< the portals as gravity counts them (`one_sided`)
  std::vector<Mass> masses;
  MassTree mass_tree;
  Coupling coupling;
  double extent = 1.0;     ///< a length of the scene's size: surfaces, portals, finite influences
  bool unbounded = false;  ///< some influence is infinite
  std::optional<Vec3d> viewpoint;  ///< where most photons begin; nothing depends on it but speed
};

}  // namespace portalens
