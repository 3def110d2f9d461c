// Where a pull has no bound: no number that is none comes of it, and both engines tell one fate.
#include <gtest/gtest.h>

#include <cmath>

#include "gravity/bound_light.h"
#include "lanes/plan.h"
#include "support/random.h"
#include "support/scale.h"
#include "support/spaces.h"

namespace portalens::test {
namespace {

/// The fate of one photon by whatever engine the space takes.
Arrival fastest(const PlannedSpace& space, const Photon& photon) {
  Arrival arrival;
  advance(space, {&photon, 1}, {&arrival, 1});
  return arrival;
}

TEST(Singular, LightThatBeginsInABareMassIsLostWithEveryEngine) {
  const Physics physics = physics_with(1e-4);
  Mass bare = mass_at({1, 2, 3}, 0.5, physics);
  bare.horizon = false;
  const PlannedSpace space = space_with(physics, {bare}, {Sphere({1, 2, -2}, 1.0)});
  ASSERT_TRUE(space.lanes);
  for (const Vec3d direction : {Vec3d{0, 0, -1}, Vec3d{1, 0, 0}, Vec3d{0.3, -0.5, 0.7}}) {
    const Photon photon = photon_at(bare.center, direction);
    EXPECT_EQ(fastest(space, photon).fate, Fate::lost);
    EXPECT_EQ(advance_one(space, photon).fate, Fate::lost);
  }
}

TEST(Singular, LightThatBeginsBesideABareMassWindsRoundItWithEveryEngine) {
  const Physics physics = physics_with(1e-4);
  Mass bare = mass_at({0, 0, 0}, 0.5, physics);
  bare.horizon = false;
  const PlannedSpace space = space_with(physics, {bare});
  const Photon photon = photon_at({0, 1e-12, 0}, {0, 0, -1});
  EXPECT_EQ(fastest(space, photon).fate, advance_one(space, photon).fate);
}

TEST(Singular, LightThatBeginsInTheMiddleOfACoreFliesStraightOut) {
  const Physics physics = physics_with(1e-4);
  Mass cluster = mass_at({0, 0, 0}, 50, physics);
  cluster.core = 0.5;
  cluster.horizon = false;
  const PlannedSpace space = space_with(physics, {cluster});
  const Photon photon = photon_at({0, 0, 0}, {0.6, 0, -0.8});
  for (const Arrival& arrival : {fastest(space, photon), advance_one(space, photon)}) {
    EXPECT_EQ(arrival.fate, Fate::escaped);
    EXPECT_LT(length(arrival.direction - photon.direction), 1e-6);
  }
}

TEST(Singular, AMassOfNothingChangesNothing) {
  const Physics physics = physics_with(1e-4);
  const Mass heavy = mass_at({0, 3, 0}, 100, physics), nothing = mass_at({0, 0, 0}, 0, physics);
  const PlannedSpace with = space_with(physics, {heavy, nothing, mass_at({0, 0, -2}, 0, physics)});
  const PlannedSpace without = space_with(physics, {heavy});
  ASSERT_TRUE(with.lanes);
  for (const Vec3d from : {Vec3d{0, 0, 5}, Vec3d{0, 0, 0}, Vec3d{0, 0, 600}}) {
    const Photon photon = photon_at(from, {0, 0, -1});  // straight at it
    const Arrival a = fastest(with, photon), b = fastest(without, photon);
    ASSERT_EQ(a.fate, Fate::escaped);
    EXPECT_LT(length(a.direction - b.direction), 1e-4);
    EXPECT_LT(length(advance_one(with, photon).direction - b.direction), 1e-4);
  }
}

/// A pair of squares, the second one turned; and a mass on it, or near.
PlannedSpace pair_with(const char* coupling, Vec3d at_mass, double core = 0.0) {
  Physics physics = physics_with(1e-4, 0.05);
  physics.portal_gravity = coupling;
  physics.max_steps = 20000;
  auto portals = portal_pair({{-3, 0, 0}, {-1, 0, 0}, {-1, 2, 0}, {-3, 2, 0}},
                             {{1, 0, -1}, {3, 0, -1}, {3, 2, -1}, {1, 2, -1}});
  Mass mass = mass_at(at_mass, 50, physics);
  mass.core = core;
  mass.horizon = core == 0.0;
  return space_with(physics, {mass}, {}, std::move(portals));
}

struct Place {
  const char* name;
  Vec3d at;
};
const Place places[] = {{"in the middle", {-2, 1, 0}},
                        {"on the face", {-2.3, 0.4, 0}},
                        {"on the rim", {-2, 0, 0}},
                        {"on a vertex", {-1, 2, 0}},
                        {"just before the face", {-2, 1, 1e-6}},
                        {"just behind it", {-2, 1, -1e-6}},
                        {"in its plane", {-4.5, 1, 0}}};

class SingularCoupling : public testing::TestWithParam<const char*> {};

TEST_P(SingularCoupling, LightMeetsOneFateWithEveryEngineWhereverTheMassIs) {
  for (const Place& place : places) {
    const PlannedSpace space = pair_with(GetParam(), place.at);
    Random random(23);
    std::vector<Photon> photons;
    for (int i = 0; i < scaled(150); ++i)
      photons.push_back(
          photon_at({0, 2, 12}, {random.uniform(-0.25, 0.25), random.uniform(-0.25, 0.1), -1.0}));
    std::vector<Arrival> fast(photons.size()), scalar(photons.size());
    advance(space, photons, fast);
    advance(space, photons, scalar, Engine::scalar);
    std::size_t unlike = 0;
    for (std::size_t i = 0; i < photons.size(); ++i) {
      ASSERT_TRUE(is_finite(fast[i].direction) && is_finite(fast[i].position)) << place.name;
      unlike += fast[i].fate != scalar[i].fate ? 1 : 0;
    }
    EXPECT_LE(unlike, 1 + photons.size() / 100) << place.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Couplings, SingularCoupling,
                         testing::Values("none", "closest-point", "graviton-map", "shortest-path",
                                         "portal-mass"));

TEST(Singular, MassesThatBindLightThroughPortalsAreFound) {
  const auto found = [](const char* coupling, Vec3d at, double core = 0.0) {
    const PlannedSpace space = pair_with(coupling, at, core);
    return bound_light(coupling, space.portals.portals(), space.masses, space.physics.c,
                       space.medium.light_sphere);
  };
  for (const char* coupling : {"closest-point", "graviton-map", "shortest-path"})
    for (std::size_t i = 0; i < 6; ++i) {
      const auto bound = found(coupling, places[i].at);
      const bool felt = i != 5 || std::string_view(coupling) != "shortest-path";  // only behind it
      ASSERT_EQ(bound.size(), felt ? 1u : 0u) << coupling << " " << places[i].name;
      if (!felt) continue;
      EXPECT_EQ(bound[0].portal, 1u);  // the mass lies on the pair of that
      EXPECT_LE(bound[0].distance, 1e-6);
    }
  EXPECT_TRUE(found("closest-point", places[6].at).empty());
  EXPECT_TRUE(found("closest-point", places[0].at, 0.1).empty());
  EXPECT_TRUE(found("portal-mass", places[0].at).empty());
  EXPECT_TRUE(found("none", places[0].at).empty());
}

}  // namespace
}  // namespace portalens::test
