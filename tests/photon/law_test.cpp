// Light under every law: what all media keep.
#include "gravity/law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <variant>
#include <vector>

#include "photon/law_spaces.h"
#include "support/list_types.h"
#include "support/random.h"
#include "support/scale.h"

namespace portalens::test {
namespace {

template <class L>
class LightUnder : public testing::Test {};

TYPED_TEST_SUITE(LightUnder, TypesOf<Law>::type);

TYPED_TEST(LightUnder, KeepsBouguersInvariantAlongItsWay) {
  const PlannedSpace space = standard_hole(TypeParam::name, 1e-9);
  const double w_rim = m / space.masses[0].influence;
  for (const double share : {5.6, 8.0, 12.0, 60.0}) {
    const Photon photon = photon_at({-500, share * m, 0}, {1, 0, 0});
    for (const double fence : {300.0, 30.0, 8.0}) {
      if (fence < share * m) continue;
      const PlannedSpace fenced = space_of(space.physics, space.masses, {Sphere{{0, 0, 0}, fence}});
      const Arrival at = advance_one(fenced, photon);
      ASSERT_EQ(at.fate, Fate::hit);
      const double log_n =
          TypeParam::log_index(m / length(at.position)) - TypeParam::log_index(w_rim);
      EXPECT_NEAR(std::exp(log_n) * length(cross(at.position, at.direction)) / (share * m), 1.0,
                  2e-9);
    }
  }
}

/// Up to four holes within reach of each other.
PlannedSpace random_holes(std::string_view law, double tolerance, Random& random, bool cores) {
  const Physics physics = physics_of(law, tolerance, 1.0);
  std::vector<Mass> masses;
  const int count = 1 + static_cast<int>(random.bits() % 4);
  for (int i = 0; i < count; ++i) {
    Mass mass = mass_at(random.point(8.0), random.uniform(100.0, 1500.0), physics);
    if (cores && i % 2 == 1) {
      mass.core = random.uniform(1.0, 3.0);
      mass.horizon = false;
    }
    masses.push_back(mass);
  }
  return space_of(physics, std::move(masses));
}

Photon towards(Random& random, double from, double aside) {
  const Vec3d start = random.direction() * from;
  return photon_at(start, random.point(aside) - start);
}

TYPED_TEST(LightUnder, GoesBackTheWayItCame) {
  Random random(21);
  int returned = 0;
  for (int i = 0; i < scaled(20); ++i) {
    const PlannedSpace space = random_holes(TypeParam::name, 1e-9, random, i % 2 == 1);
    const Photon photon = towards(random, 100.0, 15.0);
    const Arrival there = advance_one(space, photon);
    if (there.fate != Fate::escaped || there.turning > 2.0) continue;
    const Arrival back =
        advance_one(space, photon_at(there.position + there.direction, -there.direction));
    ASSERT_EQ(back.fate, Fate::escaped);
    EXPECT_LT(length(back.direction + photon.direction), 1e-7);
    EXPECT_NEAR(back.turning, there.turning, 1e-7);
    ++returned;
  }
  EXPECT_GT(returned, scaled(20) / 4);
}

TYPED_TEST(LightUnder, GoesTheSameWayInLanesWithinTheTolerance) {
  Random random(22);
  const double tolerance = 1e-4;
  std::vector<double> apart;
  int unlike = 0, count = 0;
  // Of fewer scenes a hundredth says nothing.
  for (int i = 0; i < std::max(scaled(12), 12); ++i) {
    Random again = random;
    const PlannedSpace space = random_holes(TypeParam::name, tolerance, random, i % 2 == 1);
    const PlannedSpace exact = random_holes(TypeParam::name, 1e-8, again, i % 2 == 1);
    ASSERT_TRUE(space.lanes) << space.no_lanes_because;
    std::vector<Photon> photons;
    for (int k = 0; k < 200; ++k) photons.push_back(towards(random, 60.0, 12.0));
    std::vector<Arrival> lanes(photons.size());
    advance(space, photons, lanes);
    for (std::size_t k = 0; k < photons.size(); ++k) {
      const Arrival scalar = advance_one(exact, photons[k]);
      ++count;
      if (lanes[k].fate != scalar.fate || lanes[k].object != scalar.object) {
        ++unlike;
      } else if (scalar.fate == Fate::escaped) {
        apart.push_back(length(lanes[k].direction - scalar.direction));
      } else if (scalar.fate == Fate::absorbed) {
        EXPECT_LT(length(lanes[k].position - scalar.position), 0.05) << TypeParam::name;
      }
    }
  }
  std::sort(apart.begin(), apart.end());
  ASSERT_GT(apart.size(), 100u);
  EXPECT_LE(unlike, count / 500) << TypeParam::name;
  EXPECT_LT(apart[apart.size() / 2], 0.1 * tolerance) << TypeParam::name;
  EXPECT_LT(apart[apart.size() * 99 / 100], tolerance) << TypeParam::name;
  EXPECT_LT(apart.back(), 10.0 * tolerance) << TypeParam::name;
}

TYPED_TEST(LightUnder, TakesPortalsThatActAsMassesForMasses) {
  Physics physics = physics_of(TypeParam::name, 1e-9, 0.5);
  const std::vector<Mass> holes = {mass_at({0, 0, 6}, 400.0, physics)};
  const auto portals = portal_pair({{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}},
                                   {{18, -2, 0}, {22, -2, 0}, {22, 2, 0}, {18, 2, 0}});
  physics.portal_gravity = "portal-mass";
  const PlannedSpace space = space_of(physics, holes, {}, portals);
  const auto* coupling = std::get_if<PortalMassCoupling>(&space.coupling);
  ASSERT_TRUE(coupling);
  physics.portal_gravity = "none";
  std::vector<Mass> masses = holes;
  for (const PortalMassCoupling::Image& image : coupling->images()) {
    Mass mass = mass_at(image.center, image.gm, physics);
    mass.core = std::sqrt(image.core2);
    mass.horizon = false;
    masses.push_back(mass);
  }
  ASSERT_EQ(masses.size(), 3u);
  const PlannedSpace plain = space_of(physics, masses);
  for (double y = 2.5; y < 8.0; y += 1.1) {
    const Photon photon = photon_at({-60, y, 1}, {1, 0, 0});
    const Arrival a = advance_one(space, photon), b = advance_one(plain, photon);
    ASSERT_EQ(a.fate, b.fate);
    EXPECT_LT(length(a.direction - b.direction), 1e-8) << y;
  }
}

/// Of a law's light through portals: steps of any size agree, with any coupling.
TYPED_TEST(LightUnder, FeelsPortalsTheSameInStepsOfAnySize) {
  const auto portals = portal_pair({{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}},
                                   {{22, -2, 0}, {18, -2, 0}, {18, 2, 0}, {22, 2, 0}});
  for (const std::string_view name : coupling_names()) {
    Physics physics = physics_of(TypeParam::name, 1e-9, 0.5);
    physics.portal_gravity = name;
    physics.graviton_resolution = 8;
    // In front of the portal's pair, so that it is felt through it.
    const std::vector<Mass> masses = {mass_at({20, 1, -3}, 500.0, physics)};
    const PlannedSpace space = space_of(physics, masses, {}, portals);
    physics.integrator = "rk4";
    physics.step = 2e-3;
    const PlannedSpace plain = space_of(physics, masses, {}, portals);
    const Photon photon = photon_at({-1.2, -20, 2.5}, {0.02, 1, 0.01});
    const Arrival a = advance_one(space, photon), b = advance_one(plain, photon);
    ASSERT_EQ(a.fate, b.fate) << name;
    EXPECT_LT(length(a.direction - b.direction), 5e-5) << name;  // steps of rk4 run over edges
    if (name != "none") {
      EXPECT_GT(a.turning, 1e-3) << name;
    }
  }
}

TEST(Laws, LeaveLanesWithoutThoseThatTheyDoNotTake) {
  Physics physics = physics_of("schwarzschild", 1e-4, 0.5);
  physics.portal_gravity = "closest-point";
  const auto portals = portal_pair({{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}},
                                   {{22, -2, 0}, {18, -2, 0}, {18, 2, 0}, {22, 2, 0}});
  const std::vector<Mass> masses = {mass_at({20, 1, -3}, 500.0, physics)};
  EXPECT_NE(space_of(physics, masses, {}, portals).no_lanes_because.find("schwarzschild"),
            std::string::npos);
  physics.law = "einstein";
  EXPECT_EQ(space_of(physics, masses, {}, portals).no_lanes_because, "");
  physics.portal_gravity = "none";
  physics.law = "extreme";
  EXPECT_EQ(space_of(physics, masses, {}, portals).no_lanes_because, "");
  std::vector<Mass> many;
  for (int i = 0; i < 20; ++i) many.push_back(mass_at({2.0 * i, 0, 0}, 500.0, physics));
  EXPECT_NE(space_of(physics, many).no_lanes_because.find("extreme"), std::string::npos);
}

TEST(Laws, EndLightWhereTwoHorizonsMerge) {
  // Each alone would end it only at 0.505 m; between two that are 1.6 m apart w is 2.5.
  const Physics physics = physics_of("schwarzschild", 1e-6, 0.01);
  const PlannedSpace space = space_of(physics, {mass_at({-0.8 * m, 0, 0}, standard_gm, physics),
                                                mass_at({0.8 * m, 0, 0}, standard_gm, physics)});
  const Photon photon = photon_at({0, 500, 1e-3}, {0, -1, 0});
  for (const bool in_lanes : {false, true}) {
    Arrival arrival;
    advance(space, {&photon, 1}, {&arrival, 1}, in_lanes ? Engine::automatic : Engine::scalar);
    ASSERT_EQ(arrival.fate, Fate::absorbed);
    double w = 0.0;
    for (const Mass& mass : space.masses) w += mass.potential(arrival.position) / (45.0 * 45.0);
    EXPECT_NEAR(w, 1.98, in_lanes ? 1e-4 : 1e-9);
  }
}

}  // namespace
}  // namespace portalens::test
