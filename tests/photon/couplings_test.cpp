// Light bent by masses that act through portals: every coupling at a tolerance, against the same at
// a tenth of it, in random scenes of one pair of portals.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include "gravity/portal_scenes.h"
#include "support/random.h"
#include "support/scale.h"
#include "support/spaces.h"

namespace portalens::test {
namespace {

/// A pair of 2 by 2 squares 4 to 10 apart, and masses about them.
struct BentScene {
  std::vector<Portal> portals;
  std::vector<Mass> masses;
  double min_force;
};

BentScene bent_scene(Random& random) {
  BentScene scene;
  scene.min_force = random.uniform(0.5, 1.0);
  Frame frame = random_frame(random, 0.0);
  std::vector<Vec3d> square;
  for (const auto& [x, y] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}})
    square.push_back(frame.to_world({x, y, 0.0}));
  Frame exit = random_frame(random, 0.0);
  exit.origin = random.direction() * random.uniform(4.0, 10.0);
  PortalScene pair;
  add_pair(pair, square, exit);
  scene.portals = pair.portals;
  const Physics physics = physics_with(1e-4, scene.min_force);
  const int masses = 1 + static_cast<int>(random.bits() % 3);
  for (int i = 0; i < masses; ++i) {
    const Vec3d near = i % 2 == 0 ? Vec3d{} : exit.origin;
    const Vec3d center = near + random.direction() * random.uniform(2.0, 6.0);
    scene.masses.push_back(mass_at(center, random.uniform(50.0, 400.0), physics));
  }
  return scene;
}

PlannedSpace bent_space(const BentScene& scene, std::string_view coupling, int depth,
                        double tolerance) {
  Physics physics = physics_with(tolerance, scene.min_force);
  physics.portal_gravity = coupling;
  physics.portal_gravity_depth = depth;
  return space_with(physics, scene.masses, {}, scene.portals);
}

std::vector<Photon> photons_about(const BentScene& scene, Random& random, int count) {
  std::vector<Photon> photons;
  const Vec3d middle = (scene.portals[0].frame.origin + scene.portals[1].frame.origin) * 0.5;
  for (int i = 0; i < count; ++i) {
    const Vec3d from = middle + random.direction() * random.uniform(5.0, 20.0);
    photons.push_back(photon_at(from, middle + random.point(6.0) - from));
  }
  return photons;
}

std::vector<Arrival> arrivals_of(const PlannedSpace& space, const std::vector<Photon>& photons) {
  std::vector<Arrival> arrivals(photons.size());
  advance(space, photons, arrivals, Engine::scalar);
  return arrivals;
}

/// What two runs of the same photons have in common.
struct Comparison {
  int photons = 0, different = 0, beyond = 0, escaped = 0;
  double worst = 0.0;
  double steps = 0.0;

  void add(const Arrival& coarse, const Arrival& fine, double tolerance, const std::string& which) {
    ++photons;
    steps += coarse.steps;
    if (coarse.fate != fine.fate || coarse.crossings != fine.crossings) {
      ++different;
      std::cout << which << ": " << fate_names[static_cast<std::size_t>(coarse.fate)] << " after "
                << coarse.crossings << " crossings, at a tenth of the tolerance "
                << fate_names[static_cast<std::size_t>(fine.fate)] << " after " << fine.crossings
                << '\n';
      return;
    }
    if (coarse.fate != Fate::escaped) return;
    ++escaped;
    const double error = length(coarse.direction - fine.direction);
    worst = std::max(worst, error);
    if (error <= tolerance) return;
    ++beyond;
    std::cout << which << ": " << error << ", turning " << fine.turning << ", crossings "
              << fine.crossings << ", steps " << coarse.steps << '\n';
  }
};

struct Case {
  std::string_view coupling;
  int depth;
  double tolerance;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const std::string_view name : coupling_names())
    for (const int depth : {1, 2})
      for (const double tolerance : {1e-4, 1e-5}) all.push_back({name, depth, tolerance});
  return all;
}

class EveryCoupling : public testing::TestWithParam<Case> {};

TEST_P(EveryCoupling, KeepsTheToleranceInScenesOfOnePair) {
  const auto [coupling, depth, tolerance] = GetParam();
  Comparison all;
  const int scenes = scaled(8), photons = 40;
  for (int i = 0; i < scenes; ++i) {
    Random random(static_cast<std::uint64_t>(1000 + i));
    const BentScene scene = bent_scene(random);
    const std::vector<Photon> batch = photons_about(scene, random, photons);
    const auto coarse = arrivals_of(bent_space(scene, coupling, depth, tolerance), batch);
    const auto fine = arrivals_of(bent_space(scene, coupling, depth, 0.1 * tolerance), batch);
    for (std::size_t k = 0; k < batch.size(); ++k)
      all.add(coarse[k], fine[k], tolerance,
              "scene " + std::to_string(i) + " photon " + std::to_string(k));
  }
  if (std::getenv("PORTALENS_TEST_SCALE"))
    std::cout << coupling << " depth " << depth << " tolerance " << tolerance << ": worst "
              << all.worst << " of " << all.escaped << ", different " << all.different << " of "
              << all.photons << ", steps " << all.steps / all.photons << '\n';
  EXPECT_LE(all.worst, tolerance);
  EXPECT_LE(all.different, 0.001 * all.photons);
}

/// Where no influence ends, light must still come to an end.
class UnboundedCoupling : public testing::TestWithParam<std::string_view> {};

TEST_P(UnboundedCoupling, LetsLightEscapeInTheDirectionOfALongWay) {
  const double tolerances[] = {1e-3, 1e-5};
  int escaped[] = {0, 0};
  double worst[] = {0.0, 0.0};
  for (int i = 0; i < scaled(2); ++i) {
    Random random(static_cast<std::uint64_t>(2000 + i));
    BentScene scene = bent_scene(random);
    scene.min_force = 0.0;
    for (Mass& mass : scene.masses) mass.influence = boundless;
    const std::vector<Photon> batch = photons_about(scene, random, 20);
    const int depth = 1 + i % 2;
    // At so small a tolerance the path goes on much farther.
    const auto far = arrivals_of(bent_space(scene, GetParam(), depth, 1e-8), batch);
    for (const int t : {0, 1}) {
      const auto ended = arrivals_of(bent_space(scene, GetParam(), depth, tolerances[t]), batch);
      for (std::size_t k = 0; k < batch.size(); ++k) {
        EXPECT_NE(ended[k].fate, Fate::lost);
        if (ended[k].fate != far[k].fate || ended[k].crossings != far[k].crossings) continue;
        if (ended[k].fate != Fate::escaped) continue;
        EXPECT_LT(ended[k].length, far[k].length);
        worst[t] = std::max(worst[t], length(ended[k].direction - far[k].direction));
        ++escaped[t];
      }
    }
  }
  for (const int t : {0, 1}) {
    EXPECT_LE(worst[t], tolerances[t]);
    EXPECT_GT(escaped[t], scaled(2) * 15);
  }
}

INSTANTIATE_TEST_SUITE_P(Couplings, UnboundedCoupling,
                         testing::Values("none", "shortest-path", "portal-mass"));
INSTANTIATE_TEST_SUITE_P(Cases, EveryCoupling, testing::ValuesIn(cases()));

}  // namespace
}  // namespace portalens::test
