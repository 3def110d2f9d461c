/// \file
/// Small spaces and photons that many tests start from.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "lanes/engine.h"

namespace portalens::test {

/// The constants of equations.md, sec. 3: m = 0.98765, R = 447.21.
inline constexpr double standard_gm = 2000.0;

/// A mass with the radii that follow from the physics.
inline Mass mass_at(Vec3d center, double gm, const Physics& physics) {
  Mass mass;
  mass.center = center;
  mass.gm = gm;
  mass.horizon_radius = schwarzschild_radius(gm, physics.c);
  mass.influence = influence_radius(gm, physics.min_force);
  return mass;
}

inline Physics physics_with(double tolerance, double min_force = 0.01) {
  Physics physics;
  physics.tolerance = tolerance;
  physics.min_force = min_force;
  physics.portal_gravity = "none";
  physics.max_steps = 1000000;
  return physics;
}

inline PlannedSpace space_with(const Physics& physics, std::vector<Mass> masses,
                               std::vector<Shape> shapes = {}, std::vector<Portal> portals = {}) {
  return {physics, 16, std::move(shapes), std::move(portals), std::move(masses)};
}

inline Photon photon_at(Vec3d position, Vec3d direction) {
  Photon photon;
  photon.position = position;
  photon.direction = normalize(direction);
  return photon;
}

inline Arrival advance_one(const PlannedSpace& space, const Photon& photon) {
  Arrival arrival;
  advance(space, {&photon, 1}, {&arrival, 1}, Engine::scalar);
  return arrival;
}

/// Two portals that are each other's pair, from their polygons.
inline std::vector<Portal> portal_pair(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b) {
  std::vector<Portal> portals(2);
  give_face(portals[0], polygon_input(a));
  give_face(portals[1], polygon_input(b));
  for (std::uint32_t i = 0; i < 2; ++i) portals[i].pair = 1 - i;
  for (int i = 0; i < 2; ++i)
    portals[i].passage = RigidPassage(motion_through(portals[i].frame, portals[1 - i].frame));
  return portals;
}

}  // namespace portalens::test
