// One mass against its closed forms: equations.md, sec. 3.
#include "support/closed_forms.h"

#include <gtest/gtest.h>

#include "support/spaces.h"

namespace portalens::test {
namespace {

const double m = standard_gm / (45.0 * 45.0);

PlannedSpace one_mass(double tolerance, double min_force) {
  const Physics physics = physics_with(tolerance, min_force);
  return space_with(physics, {mass_at({0, 0, 0}, standard_gm, physics)});
}

TEST(ClosedForms, ReproduceThePublishedValues) {
  const double influence = std::sqrt(standard_gm / 0.01);
  const double expected[][2] = {{3.5, 1.2099342615},
                                {4.0, 0.9011850685},
                                {6.0, 0.4624123386},
                                {10.0, 0.2383502719},
                                {30.0, 0.0700856411}};
  for (const auto& [share, turning] : expected)
    EXPECT_NEAR(closed_form::total_turning(m, influence, share * m), turning, 2e-10);
}

class ToleranceHolds : public testing::TestWithParam<double> {};

TEST_P(ToleranceHolds, ForTurningAndDirectionWithAFiniteInfluence) {
  const double allowed = GetParam() < 5e-9 ? 1e-8 : GetParam();
  const PlannedSpace space = one_mass(GetParam(), 0.01);
  for (double share = 3.31; share <= 60.0; share *= 1.07) {
    const double expected = closed_form::total_turning(m, space.masses[0].influence, share * m);
    const Arrival arrival = advance_one(space, photon_at({-500, share * m, 0}, {1, 0, 0}));
    ASSERT_EQ(arrival.fate, Fate::escaped) << "b/m = " << share;
    EXPECT_NEAR(arrival.turning, expected, allowed) << "b/m = " << share;
    EXPECT_NEAR(std::atan2(-arrival.direction.y, arrival.direction.x), expected, allowed);
  }
}

TEST_P(ToleranceHolds, ForTurningAndDirectionWithAnInfiniteInfluence) {
  const double allowed = GetParam() < 5e-9 ? 1e-8 : GetParam();
  const PlannedSpace space = one_mass(GetParam(), 0.0);
  for (double share = 3.31; share <= 60.0; share *= 1.07) {
    const double x = -200.0;
    const double expected = closed_form::turning_from(m, x, share * m);
    const Arrival arrival = advance_one(space, photon_at({x, share * m, 0}, {1, 0, 0}));
    ASSERT_EQ(arrival.fate, Fate::escaped) << "b/m = " << share;
    EXPECT_NEAR(arrival.turning, expected, allowed) << "b/m = " << share;
    EXPECT_NEAR(std::atan2(-arrival.direction.y, arrival.direction.x), expected, allowed);
  }
}

INSTANTIATE_TEST_SUITE_P(Tolerances, ToleranceHolds,
                         testing::Values(1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9));

TEST(ClosedForms, WeakDeflectionIsTwoMOverB) {
  const PlannedSpace space = one_mass(1e-7, 0.0);
  const double b = 1000.0 * m;
  const Arrival arrival = advance_one(space, photon_at({-1e5, b, 0}, {1, 0, 0}));
  ASSERT_EQ(arrival.fate, Fate::escaped);
  EXPECT_NEAR(arrival.turning / (2.0 * m / b), 1.0, 3e-3) << arrival.length;
}

TEST(ClosedForms, BouguersInvariantIsConservedAlongThePath) {
  const PlannedSpace space = one_mass(1e-9, 0.01);
  const double influence = space.masses[0].influence;
  for (double share : {3.31, 3.5, 5.0, 12.0, 60.0}) {
    PathTrace path_trace;
    const Arrival arrival =
        advance_recorded(space, photon_at({-500, share * m, 0}, {1, 0, 0}), path_trace);
    ASSERT_EQ(arrival.fate, Fate::escaped);
    const Vec3d x = arrival.position, t = arrival.direction;
    EXPECT_NEAR(length(cross(x, t)) / (share * m), 1.0, 1e-9) << share;
    // On the path: what a fence of that radius stops.
    const Photon photon = photon_at({-500, share * m, 0}, {1, 0, 0});
    for (double fence : {300.0, 30.0, 8.0}) {
      if (fence < share * m) continue;
      const Physics physics = space.physics;
      const Sphere wall{{0, 0, 0}, fence};
      const PlannedSpace fenced = space_with(physics, space.masses, {wall});
      const Arrival at = advance_one(fenced, photon);
      ASSERT_EQ(at.fate, Fate::hit);
      const double r = length(at.position);
      const double n = std::exp(m / r - m / influence);
      EXPECT_NEAR(n * length(cross(at.position, at.direction)) / (share * m), 1.0, 1e-9);
    }
  }
}

TEST(ClosedForms, TheBlackDiscHasTheRadiusOfCapture) {
  for (const double min_force : {0.0, 0.01}) {
    const PlannedSpace space = one_mass(1e-8, min_force);
    const double start = -400.0;
    double low = 3.0 * m, high = 4.0 * m;
    while (high - low > 1e-9 * m) {
      const double b = 0.5 * (low + high);
      const Arrival arrival =
          advance_one(space, photon_at({min_force > 0 ? -500.0 : start, b, 0}, {1, 0, 0}));
      (arrival.fate == Fate::absorbed ? low : high) = b;
    }
    // Seen from inside an infinite influence the invariant, not the offset, is what is captured.
    const double measured = min_force > 0 ? low : low * std::exp(m / std::hypot(start, low));
    const double expected =
        2.0 * m * std::exp(0.5 - (min_force > 0 ? m / space.masses[0].influence : 0.0));
    EXPECT_NEAR(measured / expected, 1.0, 1e-6);
  }
}

TEST(ClosedForms, CaptureOutsideTheInfluenceIsTheHorizonItself) {
  const PlannedSpace space = one_mass(1e-8, 1e5);  // R < r_s
  ASSERT_LT(space.masses[0].influence, space.masses[0].horizon_radius);
  const double edge = space.masses[0].horizon_radius;
  EXPECT_EQ(advance_one(space, photon_at({-50, edge * (1 - 1e-9), 0}, {1, 0, 0})).fate,
            Fate::absorbed);
  EXPECT_EQ(advance_one(space, photon_at({-50, edge * (1 + 1e-9), 0}, {1, 0, 0})).fate,
            Fate::escaped);
}

TEST(ClosedForms, AbsorptionHappensOnTheHorizon) {
  const PlannedSpace space = one_mass(1e-6, 0.01);
  for (double share = 0.0; share < 3.29; share += 0.3) {
    const Arrival arrival = advance_one(space, photon_at({-500, share * m, 0}, {1, 0, 0}));
    ASSERT_EQ(arrival.fate, Fate::absorbed);
    EXPECT_NEAR(length(arrival.position), space.masses[0].horizon_radius, 1e-10);
  }
}

TEST(ClosedForms, APathIsReversible) {
  const PlannedSpace space = one_mass(1e-8, 0.01);
  const Arrival there = advance_one(space, photon_at({-500, 5 * m, 3}, {1, 0, 0}));
  const Vec3d far = there.position + there.direction * 100.0;
  const Arrival back = advance_one(space, photon_at(far, -there.direction));
  EXPECT_NEAR(back.direction.x, -1.0, 1e-8);
  EXPECT_NEAR(back.turning, there.turning, 1e-8);
}

TEST(ClosedForms, AStartInsideAHorizonEndsAtLengthZero) {
  const Arrival arrival = advance_one(one_mass(1e-4, 0.01), photon_at({1.0, 0.5, 0}, {1, 0, 0}));
  EXPECT_EQ(arrival.fate, Fate::absorbed);
  EXPECT_EQ(arrival.length, 0.0);
}

TEST(ClosedForms, NothingOrbitsOneMassOutsideItsHorizon) {
  const PlannedSpace space = one_mass(1e-6, 0.01);
  double most = 0.0;
  for (double share = 3.298; share < 4.0; share *= 1.00001) {
    const Arrival arrival = advance_one(space, photon_at({-500, share * m, 0}, {1, 0, 0}));
    ASSERT_TRUE(arrival.fate == Fate::escaped || arrival.fate == Fate::absorbed);
    if (arrival.fate == Fate::escaped) most = std::fmax(most, arrival.turning);
  }
  EXPECT_LT(most, 1.5);
  EXPECT_GT(most, 1.3);
}

}  // namespace
}  // namespace portalens::test
