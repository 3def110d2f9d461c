/// \file
/// Random pairs of portals and masses around them, and a corridor between facing portals.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "gravity/coupling.h"
#include "support/random.h"

namespace portalens::test {

inline constexpr double boundless = std::numeric_limits<double>::infinity();

struct PortalScene {
  std::vector<Portal> portals;
  std::vector<Mass> masses;
  double min_force = 0.0;

  [[nodiscard]] CouplingInput input(int depth, int resolution = 32) const {
    return {portals, masses, min_force, depth, resolution};
  }
};

inline Portal portal_on(const std::vector<Vec3d>& vertices) {
  Portal portal;
  give_face(portal, polygon_input(vertices));
  return portal;
}

/// Adds a portal on `vertices` and its pair in `exit`, the frame in which the pair has its own.
inline void add_pair(PortalScene& scene, const std::vector<Vec3d>& vertices, const Frame& exit) {
  Portal a = portal_on(vertices);
  const std::size_t count = vertices.size();
  std::vector<Vec3d> partner(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d local = a.frame.to_local(vertices[i]);
    partner[(count + 1 - i) % count] = exit.to_world({-local.x, local.y, 0.0});
  }
  Portal b = portal_on(partner);
  const auto first = static_cast<std::uint32_t>(scene.portals.size());
  a.pair = first + 1;
  b.pair = first;
  a.passage = RigidPassage(motion_through(a.frame, b.frame));
  b.passage = RigidPassage(motion_through(b.frame, a.frame));
  scene.portals.push_back(a);
  scene.portals.push_back(b);
}

inline Frame random_frame(Random& random, double size) {
  const Vec3d normal = random.direction();
  const Vec3d right = normalize(cross(random.direction(), normal));
  return {random.point(size), right, cross(normal, right), normal};
}

/// A convex polygon of 3 to 6 vertices on an ellipse.
inline std::vector<Vec3d> random_polygon(Random& random, double size) {
  const Frame frame = random_frame(random, size);
  const int count = 3 + static_cast<int>(random.bits() % 4);
  const double a = random.uniform(0.5, 1.5), b = random.uniform(0.5, 1.5);
  std::vector<Vec3d> vertices;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + random.uniform(0.0, 0.7)) / count;
    vertices.push_back(frame.to_world({a * std::cos(angle), b * std::sin(angle), 0.0}));
  }
  return vertices;
}

inline void add_mass(PortalScene& scene, Vec3d center, double gm, double core = 0.0) {
  Mass mass;
  mass.center = center;
  mass.gm = gm;
  mass.core = core;
  mass.influence = influence_radius(gm, scene.min_force);
  scene.masses.push_back(mass);
}

/// Pairs and masses anywhere within `size`; the first portal is massive. Influences reach a few
/// lengths where `min_force` is positive.
inline PortalScene random_scene(Random& random, int pairs, int masses, double size,
                                double min_force) {
  PortalScene scene;
  scene.min_force = min_force;
  for (int i = 0; i < pairs; ++i)
    add_pair(scene, random_polygon(random, size), random_frame(random, size));
  for (int i = 0; i < masses; ++i)
    add_mass(scene, random.point(size), random.uniform(0.2, 1.0),
             i % 3 == 2 ? random.uniform(0.0, 0.5) : 0.0);
  if (!scene.portals.empty())
    add_mass(scene, scene.portals[0].frame.origin, random.uniform(0.2, 1.0));
  return scene;
}

/// Squares of half-width `w`: a floor at y = 0 that faces up, and its pair, a ceiling at y = `h`
/// that faces down, so that entering the floor adds h to y.
inline PortalScene corridor(double w, double h) {
  PortalScene scene;
  const std::vector<Vec3d> floor = {{-w, 0, w}, {w, 0, w}, {w, 0, -w}, {-w, 0, -w}};
  const Frame frame = polygon_frame(floor);
  add_pair(scene, floor, {Vec3d{0, h, 0}, -frame.right, frame.up, -frame.normal});
  return scene;
}

inline double relative_difference(Vec3d a, Vec3d b) {
  const double size = std::max(length(a), length(b));
  return size > 0.0 ? length(a - b) / size : 0.0;
}

}  // namespace portalens::test
