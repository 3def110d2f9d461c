// Scenes of every size, in lanes where floats hold them, and what lanes say of those that they
// leave.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lanes/plan.h"
#include "support/faces.h"
#include "support/random.h"
#include "support/scale.h"
#include "support/spaces.h"

namespace portalens::test {
namespace {

/// Two masses, of which one has a core, a pair of portals and a ball; all lengths times `s`.
PlannedSpace space_of_size(double s, const char* coupling) {
  Physics physics = physics_with(1e-4, 0.05 / s);
  physics.portal_gravity = coupling;
  physics.max_length *= s;
  std::vector<Mass> masses = {mass_at({-2 * s, s, s}, 50 * s, physics),
                              mass_at({2 * s, s, 0.5 * s}, 80 * s, physics)};
  masses[1].core = 0.3 * s;
  masses[1].horizon = false;
  const auto at = [s](double x, double y, double z) { return Vec3d{x, y, z} * s; };
  auto portals = portal_pair({at(-1, 0, 0), at(1, 0, 0), at(1, 2, 0), at(-1, 2, 0)},
                             {at(4, 0, -1), at(6, 0, -1), at(6, 2, -1), at(4, 2, -1)});
  return space_with(physics, std::move(masses), {Sphere(at(0, 1, -3), 0.5 * s)},
                    std::move(portals));
}

std::vector<Arrival> arrivals_in(const PlannedSpace& space, double s, Engine engine) {
  Random random(5);
  std::vector<Photon> photons;
  for (int i = 0; i < scaled(150); ++i)
    photons.push_back(photon_at(Vec3d{0, 2, 12} * s,
                                {random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.2), -1.0}));
  std::vector<Arrival> arrivals(photons.size());
  advance(space, photons, arrivals, engine);
  return arrivals;
}

class ScaleOfCoupling : public testing::TestWithParam<const char*> {};

TEST_P(ScaleOfCoupling, LightTakesTheSameWaysAtEverySizeWithEveryEngine) {
  const auto expected = arrivals_in(space_of_size(1.0, GetParam()), 1.0, Engine::scalar);
  for (int power = -12; power <= 12; power += 3) {
    const double s = std::pow(10.0, power);
    const PlannedSpace space = space_of_size(s, GetParam());
    for (const Engine engine : {Engine::scalar, Engine::automatic}) {
      const auto arrivals = arrivals_in(space, s, engine);
      std::size_t unlike = 0;
      std::vector<double> apart;
      for (std::size_t i = 0; i < arrivals.size(); ++i) {
        const Arrival &a = arrivals[i], &b = expected[i];
        ASSERT_NE(a.fate, Fate::lost) << power << " " << i;
        if (a.fate != b.fate || a.crossings != b.crossings)
          ++unlike;
        else
          apart.push_back(length(a.direction - b.direction));
      }
      std::sort(apart.begin(), apart.end());
      EXPECT_LE(unlike, 1 + arrivals.size() / 100) << power;
      EXPECT_LT(apart[apart.size() / 2], 1e-5) << power;
      EXPECT_LT(apart[apart.size() * 97 / 100], 1e-3) << power;
    }
  }
}

TEST_P(ScaleOfCoupling, LanesTakeWhatFloatsHoldAndSayWhyNotTheRest) {
  for (const double s : {1e-4, 1e-2, 1.0, 1e3, 1e5})
    EXPECT_TRUE(space_of_size(s, GetParam()).lanes) << s;
  for (const double s : {1e-12, 1e-9, 1e9, 1e12}) {
    const PlannedSpace space = space_of_size(s, GetParam());
    EXPECT_FALSE(space.lanes) << s;
    EXPECT_NE(space.no_lanes_because.find("another unit of length"), std::string::npos)
        << space.no_lanes_because;
  }
}

INSTANTIATE_TEST_SUITE_P(Couplings, ScaleOfCoupling,
                         testing::Values("none", "closest-point", "graviton-map", "shortest-path",
                                         "portal-mass"));

std::string refusal_of(const Physics& physics, std::vector<Mass> masses,
                       std::vector<Portal> portals = {}) {
  const PlannedSpace space = space_with(physics, std::move(masses), {}, std::move(portals));
  EXPECT_EQ(space.lanes == nullptr, !space.no_lanes_because.empty());
  return space.no_lanes_because;
}

TEST(LaneRefusal, NamesWhatTheSceneHasAndWhatLanesTake) {
  const auto expect = [](const std::string& refusal, const char* words) {
    EXPECT_NE(refusal.find(words), std::string::npos) << refusal << "\nlacks: " << words;
  };
  const Physics usual = physics_with(1e-4);
  Mass mass = mass_at({0, 0, 0}, 400, usual);
  mass.name = "hole";
  EXPECT_EQ(refusal_of(usual, {mass}), "");
  Physics physics = usual;
  physics.integrator = "rk4";
  expect(refusal_of(physics, {}), "physics.integrator is 'rk4' (lanes take \"adaptive\")");
  expect(refusal_of(physics_with(1e-6), {}), "1e-06 is finer than floats keep (lanes take 1e-05)");
  physics = physics_with(1e-4, 0.0);
  expect(refusal_of(physics, {mass_at({0, 0, 0}, 400, physics)}), "physics.min_force = 0");
  Mass dust = mass_at({1, 0, 0}, 1e-9, usual);
  dust.name = "dust";
  expect(refusal_of(usual, {mass, dust}), "of mass 'dust' is 4.94e-13 (lanes take 2e-09");
  Mass far = mass_at({1e9, 0, 0}, 400, physics_with(1e-4, 1.0));
  far.name = "far";
  Mass near = far;
  near.center = {};
  expect(refusal_of(physics_with(1e-4, 1.0), {near, far}), "in size, influences counted");
  far.center.x = 2e7;
  expect(refusal_of(physics_with(1e-4, 1.0), {near, far}), "mass 'far' lies further off than");
}

TEST(LaneRefusal, NamesThePortalThatLanesDoNotTake) {
  const auto polygon = [](int count, Vec3d center) {
    std::vector<Vec3d> vertices;
    for (int k = 0; k < count; ++k) {
      const double angle = 6.283185307179586 * (k + 0.5) / count - 1.5707963267948966;
      vertices.push_back(center + Vec3d{std::cos(angle), std::sin(angle), 0});
    }
    return vertices;
  };
  Physics physics = physics_with(1e-4);
  physics.portal_gravity = "closest-point";
  const auto pair_of = [&](int count) {
    auto portals = portal_pair(polygon(count, {0, 0, 0}), polygon(count, {5, 0, 0}));
    portals[0].name = "door";
    return portals;
  };
  const Mass mass = mass_at({0, 4, 0}, 40, physics);
  EXPECT_EQ(refusal_of(physics, {mass}, pair_of(8)), "");
  EXPECT_EQ(refusal_of(physics, {mass}, pair_of(65)), "portal 'door' has 65 edges (lanes take 64)");
  for (const char* coupling : {"graviton-map", "shortest-path"}) {
    physics.portal_gravity = coupling;
    EXPECT_EQ(refusal_of(physics, {mass}, pair_of(6)), "");
  }
  auto round = pair_of(6);
  for (Portal& portal : round) give_face(portal, ellipse_input(portal.frame, 1.0, 0.8));
  const std::string odd = refusal_of(physics, {mass}, round);
  EXPECT_EQ(odd.find("portal 'door' is an ellipse"), 0u) << odd;
}

}  // namespace
}  // namespace portalens::test
