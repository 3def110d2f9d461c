// Photons in lanes against the scalar engine, and instruction sets against each other.
#include "support/lanes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

#include "support/random.h"
#include "support/scale.h"
#include "support/spaces.h"

namespace portalens::test {
namespace {

/// A ground, spheres, triangles, a mass and a pair of portals, like the paper's figure 7.
PlannedSpace busy_space(const char* coupling, int depth) {
  Physics physics = physics_with(1e-4, 1.0);
  physics.portal_gravity = coupling;
  physics.portal_gravity_depth = depth;
  physics.max_steps = 20000;
  std::vector<Shape> shapes;
  const std::array<Vec3d, 4> ground = {{{-30, 0, 30}, {30, 0, 30}, {30, 0, -30}, {-30, 0, -30}}};
  shapes.emplace_back(Quad(ground));
  Random random(11);
  for (int i = 0; i < 8; ++i) {
    const Vec3d at = {random.uniform(-6, 6), random.uniform(0.5, 4), random.uniform(-8, -3)};
    const std::array<Vec3d, 3> triangle = {
        {at, at + random.point(1.0), at + random.point(1.0) + Vec3d{0.3, 0.5, 0}}};
    shapes.emplace_back(Quad(triangle));
  }
  for (int i = 0; i < 3; ++i)
    shapes.emplace_back(Sphere({random.uniform(-5, 5), 1.0, random.uniform(-6, 0)}, 0.7));
  shapes.emplace_back(Cube({4, 0.5, -1}, {1, 1, 1}, {0, 30, 0}));
  auto pair = portal_pair({{-4, 0.5, -2}, {-2, 0.5, -2}, {-2, 2.5, -2}, {-4, 2.5, -2}},
                          {{5, 0.5, -3}, {3, 0.5, -3.5}, {3, 2.5, -3.5}, {5, 2.5, -3}});
  const double wide = length(pair[1].vertices[1] - pair[1].vertices[0]);
  pair = portal_pair({{-4, 0.5, -2}, {-4 + wide, 0.5, -2}, {-4 + wide, 2.5, -2}, {-4, 2.5, -2}},
                     {{3, 0.5, -3.5}, {5, 0.5, -3}, {5, 2.5, -3}, {3, 2.5, -3.5}});
  return space_with(physics, {mass_at({-3, 1.5, 0.5}, 400, physics)}, std::move(shapes), pair);
}

std::vector<Photon> camera_photons(int count) {
  Random random(12);
  std::vector<Photon> photons;
  for (int i = 0; i < count; ++i)
    photons.push_back(
        photon_at({0, 2, 12}, {random.uniform(-0.5, 0.5), random.uniform(-0.3, 0.25), -1.0}));
  return photons;
}

/// @param deep  through many portals in a row, which adds up, and so do errors
void expect_alike(const std::vector<Arrival>& lanes, const std::vector<Arrival>& scalar,
                  bool deep) {
  std::vector<double> apart;
  std::size_t unlike = 0;
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const Arrival &a = lanes[i], &b = scalar[i];
    if (a.fate != b.fate || a.object != b.object || a.crossings != b.crossings) {
      ++unlike;
    } else if (a.fate == Fate::escaped) {
      apart.push_back(length(a.direction - b.direction));
    } else {
      apart.push_back(length(a.position - b.position) / (1.0 + b.length));
    }
  }
  std::sort(apart.begin(), apart.end());
  EXPECT_LT(static_cast<double>(unlike), 0.003 * static_cast<double>(lanes.size()) + 2);
  EXPECT_LT(apart[apart.size() / 2], deep ? 1e-4 : 3e-5);
  EXPECT_LT(apart[apart.size() * 98 / 100], deep ? 1e-3 : 4e-4);
}

class LanesOfCoupling : public testing::TestWithParam<std::pair<const char*, int>> {};

TEST_P(LanesOfCoupling, AgreeWithTheScalarEngineWithinFloatButForFewPhotons) {
  const PlannedSpace space = busy_space(GetParam().first, GetParam().second);
  ASSERT_TRUE(space.lanes);
  const auto photons = camera_photons(scaled(5000));
  std::vector<Arrival> scalar(photons.size());
  ASSERT_NE(lane_engine().step, nullptr);
  advance(space, photons, scalar, Engine::scalar);
  const bool deep = GetParam().second > 2;
  expect_alike(in_lanes(space, photons, lane_engine().name), scalar, deep);
  // Those that round products and sums apart, too.
  if (lane_engine("sse4-plain").step)
    expect_alike(in_lanes(space, photons, "sse4-plain"), scalar, deep);
}

TEST(Lanes, OfProcessorsWithoutFmaSayThatTheirBitsAreOthers) {
  const LaneEngine plain = lane_engine("sse4-plain"), exact = lane_engine("sse4");
  if (!plain.step) GTEST_SKIP() << "this processor has no SSE 4.2";
  EXPECT_FALSE(plain.rounds_as_all);
  EXPECT_TRUE(exact.rounds_as_all);
  EXPECT_TRUE(lane_engine().rounds_as_all || lane_engine().name == plain.name);
  const PlannedSpace space = busy_space("closest-point", 1);
  const auto photons = camera_photons(100);
  const auto a = in_lanes(space, photons, plain.name), b = in_lanes(space, photons, exact.name);
  const auto differ = [](const Arrival& x, const Arrival& y) { return x.direction != y.direction; };
  EXPECT_FALSE(std::equal(a.begin(), a.end(), b.begin(), std::not_fn(differ)));
}

TEST_P(LanesOfCoupling, GiveTheSameBitsWithEveryInstructionSet) {
  expect_same_bits_with_every_set(busy_space(GetParam().first, GetParam().second),
                                  camera_photons(scaled(5000)));
}

INSTANTIATE_TEST_SUITE_P(Couplings, LanesOfCoupling,
                         testing::Values(std::pair("none", 0), std::pair("closest-point", 1),
                                         std::pair("closest-point", 2),
                                         std::pair("closest-point", 8),
                                         std::pair("graviton-map", 1), std::pair("graviton-map", 2),
                                         std::pair("graviton-map", 6),
                                         std::pair("shortest-path", 1),
                                         std::pair("portal-mass", 1)));

TEST(Lanes, APhotonsAnswerDoesNotDependOnItsNeighbours) {
  const PlannedSpace space = busy_space("closest-point", 1);
  const auto photons = camera_photons(500);
  const auto together = in_lanes(space, photons, lane_engine().name);
  for (std::size_t i = 0; i < photons.size(); i += 7) {
    const auto alone = in_lanes(space, {photons[i]}, lane_engine().name);
    ASSERT_EQ(alone[0].position, together[i].position);
    ASSERT_EQ(alone[0].turning, together[i].turning);
  }
}

/// Strong fields bend single steps so much that they may dip through a plane far from what lies in
/// it; whether one does must not depend on a neighbour that comes near.
TEST(Lanes, APhotonsAnswerDoesNotDependOnItsNeighboursThatComeNearAPlane) {
  Physics physics = physics_with(1e-4, 0.001);
  physics.c = 6.0;
  std::vector<Mass> masses = {mass_at({2.78817, 3.72122, -0.853614}, 166.768, physics),
                              mass_at({-1.25957, 0.283575, -2.05997}, 46.3967, physics),
                              mass_at({0.913868, -0.646054, -1.7744}, 47.8226, physics),
                              mass_at({-2.938, 0.0886091, 2.89497}, 4.73079, physics)};
  const double cores[] = {1.38248, 1.93743, 0.149917, 0.113498};
  for (std::size_t i = 0; i < masses.size(); ++i) {
    masses[i].horizon = false;
    masses[i].core = cores[i];
  }
  std::vector<Shape> shapes;
  shapes.emplace_back(
      Quad(std::array<Vec3d, 4>{{{-60, -4, 30}, {60, -4, 30}, {60, -4, -60}, {-60, -4, -60}}}));
  shapes.emplace_back(Quad(std::array<Vec3d, 4>{{{4.37246894, 2.01018481, -2.74536654},
                                                 {5.00493879, 2.05191086, -2.66603874},
                                                 {4.99659358, 2.17840483, -2.66603874},
                                                 {4.36412373, 2.13667878, -2.74536654}}}));
  const PlannedSpace space = space_with(physics, masses, std::move(shapes));
  ASSERT_TRUE(space.lanes);
  std::vector<Photon> photons;  // row by row, so that neighbours go similar paths
  for (double y = 0.2; y > -0.1; y -= 0.0057)
    for (double x = -0.36; x < 0.36; x += 0.0057)
      photons.push_back(photon_at({0.922887, 0.848301, 13}, {x - 0.07, y + 0.05, -1.0}));
  std::vector<Arrival> together(photons.size()), alone(1);
  advance(space, photons, together);
  for (std::size_t i = 0; i < photons.size(); ++i) {
    advance(space, {&photons[i], 1}, alone);
    ASSERT_EQ(alone[0].fate, together[i].fate) << i;
    ASSERT_EQ(alone[0].position, together[i].position) << i;
    ASSERT_EQ(alone[0].direction, together[i].direction) << i;
    ASSERT_EQ(alone[0].length, together[i].length) << i;
  }
}

TEST(Lanes, MeetAHorizonFromFarAwayWhereItIs) {
  // The horizon is larger than the influence, so that ways are straight until they meet it.
  const Physics physics = physics_with(1e-4, 800.0);
  const PlannedSpace space =
      space_with(physics, {mass_at({0, 0, 0}, standard_gm, physics)}, {Sphere({0, 0, -50}, 30.0)});
  for (const double distance : {2.5, 5.0, 20.0, 100.0, 400.0})
    for (const double aside : {0.0, 0.7, 1.5, 1.9, 1.97, 1.98}) {
      const Photon photon = photon_at({0, aside, distance}, {0, 0, -1});
      Arrival lanes;
      advance(space, {&photon, 1}, {&lanes, 1});
      const Arrival scalar = advance_one(space, photon);
      ASSERT_EQ(lanes.fate, scalar.fate) << distance << " " << aside;
      EXPECT_LT(length(lanes.position - scalar.position), 1e-4 * distance) << distance;
    }
}

TEST(Lanes, LeaveAnInfluenceThatTheyGrazeWhereItEnds) {
  const Physics physics = physics_with(1e-4, 10.0);  // R = 14.1
  const PlannedSpace space =
      space_with(physics, {mass_at({0, 0, 0}, standard_gm, physics)}, {Sphere({0, 0, 0}, 2.5)});
  Random random(3);
  int off = 0;
  const int count = scaled(20000);
  std::vector<Photon> photons;
  for (int i = 0; i < count; ++i) {
    const Vec3d from{5, 20, 120};
    photons.push_back(photon_at(from, random.point(18.0) - from));
  }
  std::vector<Arrival> lanes(photons.size()), scalar(photons.size());
  advance(space, photons, lanes);
  advance(space, photons, scalar, Engine::scalar);
  for (std::size_t i = 0; i < photons.size(); ++i)
    if (lanes[i].fate == Fate::escaped && scalar[i].fate == Fate::escaped)
      off += length(lanes[i].direction - scalar[i].direction) > 2e-3 ? 1 : 0;
  EXPECT_EQ(off, 0);
}

TEST(Lanes, FlyOutOfASceneInOneStep) {
  for (const char* coupling : {"closest-point", "graviton-map"}) {
    const PlannedSpace space = busy_space(coupling, 1);
    ASSERT_TRUE(space.lanes);
    Random random(19);
    std::vector<Photon> photons;
    for (int i = 0; i < scaled(1000); ++i) {
      // Away from a place within the scene, from out of it.
      const Vec3d away = normalize(random.point(1.0));
      photons.push_back(photon_at(random.point(2.0) + away * random.uniform(60, 200), away));
    }
    std::vector<Arrival> arrivals(photons.size());
    advance(space, photons, arrivals);
    for (const Arrival& arrival : arrivals) {
      ASSERT_EQ(arrival.fate, Fate::escaped) << coupling;
      ASSERT_LE(arrival.steps, 1u) << coupling;
      ASSERT_EQ(arrival.handed_over, 0u) << coupling;
    }
  }
}

/// A step that ends a little before the border that it was to end behind needs another one for the
/// rest. Of planes hardly any is left, of the borders of what is within reach most.
TEST(Lanes, EndStepsBehindTheBordersThatTheyForesee) {
  const PlannedSpace space = busy_space("closest-point", 1);
  const auto photons = camera_photons(scaled(4000));
  std::vector<Arrival> arrivals(photons.size());
  std::vector<PathRecord> records(photons.size());
  advance_with_records(space, photons, arrivals, records);
  int steps = 0, rests = 0;
  for (const PathRecord& record : records) {
    if (!record.known()) continue;
    const auto points = record.points();
    for (std::size_t k = 2; k < points.size(); ++k) {
      ++steps;
      const double before = points[k - 1].length - points[k - 2].length;
      const double length = points[k].length - points[k - 1].length;
      rests += length < before / 40.0 && length > before / 4000.0 ? 1 : 0;
    }
  }
  EXPECT_GT(steps, 10 * static_cast<int>(photons.size()) / 4);
  EXPECT_LT(rests, steps / 10);
}

/// Light that would come nearer than e m winds into a mass without a horizon, and never comes back.
TEST(Lanes, FollowLightThatWindsIntoABareMass) {
  const Physics physics = physics_with(1e-4, 0.05);
  Mass bare = mass_at({0, 0, 0}, 600, physics);
  bare.horizon = false;
  const PlannedSpace space = space_with(physics, {bare});
  ASSERT_TRUE(space.lanes);
  const double m = gravitational_radius(bare.gm, physics.c);
  Random random(17);
  std::vector<Photon> photons;
  for (int i = 0; i < scaled(500); ++i) {
    const double b = 0.97 * std::exp(1.0) * m * std::sqrt(random.uniform(0.0, 1.0));
    const double angle = random.uniform(0.0, 6.28);
    photons.push_back(photon_at({b * std::cos(angle), b * std::sin(angle), 11}, {0, 0, -1}));
  }
  std::vector<Arrival> arrivals(photons.size());
  advance(space, photons, arrivals);
  for (const Arrival& arrival : arrivals) EXPECT_EQ(arrival.fate, Fate::trapped);
}

TEST(Lanes, LeaveMassesThatFloatsCanNotPlaceToTheScalarEngine) {
  const Physics physics = physics_with(1e-4, 1.0);
  const Mass near = mass_at({0, 0, 0}, 400, physics);
  EXPECT_TRUE(space_with(physics, {near, mass_at({1e4, 0, 0}, 400, physics)}).lanes);
  EXPECT_FALSE(space_with(physics, {near, mass_at({1e12, 0, 0}, 400, physics)}).lanes);
}

TEST(Lanes, LeaveWhatTheyCanNotDoToTheScalarEngine) {
  Physics physics = physics_with(1e-7);
  EXPECT_FALSE(space_with(physics, {}).lanes);
  physics = physics_with(1e-4, 0.0);
  EXPECT_FALSE(space_with(physics, {mass_at({0, 0, 0}, 2000, physics)}).lanes);
  physics = physics_with(1e-4);
  physics.integrator = "euler";
  EXPECT_FALSE(space_with(physics, {}).lanes);
}

}  // namespace
}  // namespace portalens::test
