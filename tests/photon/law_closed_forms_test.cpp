// Light under each law, as its closed forms and another integrator have it.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "photon/law_spaces.h"
#include "support/random.h"

namespace portalens::test {
namespace {

/// One hole of m = 1 in the origin, felt without an end.
PlannedSpace one_hole(std::string_view law, double tolerance) {
  Physics physics = physics_of(law, tolerance, 0.0);
  physics.c = 1.0;
  return space_of(physics, {mass_at({0, 0, 0}, 1.0, physics)});
}

/// The total turning of light that passes one mass of m = 1 at the impact parameter b.
struct Turning {
  double b;
  std::array<std::optional<double>, 4> of;  ///< newton, einstein, schwarzschild, extreme
};

constexpr std::array<std::string_view, 4> four_laws = {"newton", "einstein", "schwarzschild",
                                                       "extreme"};

TEST(Laws, TurnLightAboutOneMassAsTheClosedFormsSay) {
  const Turning table[] = {
      {4.1, {0.862464257471, {}, {}, 4.57575791084}},
      {5.2, {0.573898201422, {}, 6.81037195666, 1.63653110272}},
      {5.5, {0.526854563652, 4.01650335553, 2.55302018235, 1.43499449587}},
      {6, {0.463902469515, 1.99974611306, 1.71938831023, 1.19740370668}},
      {8, {0.315066374302, 0.905165478514, 0.858730018079, 0.733837959500}},
      {10, {0.239033623770, 0.610437437032, 0.590395787606, 0.533242659072}},
      {50, {0.0413067408420, 0.0854458502470, 0.0850834503832, 0.0839973617447}},
      {1000, {0.00200314760525, 0.00401261457257, 0.00401182380993, 0.00400945152736}}};
  for (std::size_t l = 0; l < four_laws.size(); ++l) {
    const PlannedSpace space = one_hole(four_laws[l], 1e-9);
    const double start = 1e7;
    const double log_index =
        std::visit([&](const auto& law) { return law.log_index(1.0 / start); }, space.law);
    for (const Turning& row : table) {
      const Arrival arrival =
          advance_one(space, photon_at({-start, row.b * std::exp(-log_index), 0}, {1, 0, 0}));
      if (!row.of[l]) {
        EXPECT_EQ(arrival.fate, Fate::absorbed) << four_laws[l] << ", b = " << row.b;
        continue;
      }
      ASSERT_EQ(arrival.fate, Fate::escaped) << four_laws[l] << ", b = " << row.b;
      EXPECT_NEAR(arrival.turning, *row.of[l], std::fmax(1e-8 * *row.of[l], 2e-9))
          << four_laws[l] << ", b = " << row.b;
    }
  }
}

/// In the influence of a mass like that of equations.md, sec. 3, which ends at R: by b/m.
const Turning finite_table[] = {
    {5.5, {0.525088161925, 3.70188708037, 2.48353841325, 1.42098465772}},
    {6, {0.462412338673, 1.96110027537, 1.69344474956, 1.18708370776}},
    {8, {0.314140950897, 0.897194410358, 0.851633562582, 0.728867266968}},
    {10, {0.238350271919, 0.606059096728, 0.586313035449, 0.529962980515}},
    {30, {0.0700856411364, 0.148332631732, 0.147226993829, 0.143920258344}}};

constexpr std::array<double, 4> finite_capture = {3.290168299591, 5.412603719818, 5.173258320787,
                                                  3.982390658196};

TEST(Laws, TurnLightInAFiniteInfluenceAsTheClosedFormsSay) {
  for (std::size_t l = 0; l < four_laws.size(); ++l) {
    const PlannedSpace space = standard_hole(four_laws[l], 1e-9);
    for (const Turning& row : finite_table) {
      const Arrival arrival = advance_one(space, photon_at({-500, row.b * m, 0}, {1, 0, 0}));
      ASSERT_EQ(arrival.fate, Fate::escaped) << four_laws[l];
      EXPECT_NEAR(arrival.turning, *row.of[l], 1e-8) << four_laws[l] << ", b = " << row.b;
    }
  }
}

TEST(Laws, TurnLightInLanesAsTheClosedFormsSay) {
  for (std::size_t l = 0; l < four_laws.size(); ++l) {
    const PlannedSpace space = standard_hole(four_laws[l], 1e-5);
    ASSERT_TRUE(space.lanes) << space.no_lanes_because;
    for (const Turning& row : finite_table) {
      // From all sides: what is rounded differs.
      std::vector<Photon> photons;
      Random random(7);
      for (int i = 0; i < 64; ++i) {
        const Vec3d along = random.direction(), aside = normalize(cross(along, random.direction()));
        photons.push_back(photon_at(aside * (row.b * m) - along * 500.0, along));
      }
      std::vector<Arrival> arrivals(photons.size());
      advance(space, photons, arrivals);
      for (const Arrival& arrival : arrivals) {
        ASSERT_EQ(arrival.fate, Fate::escaped) << four_laws[l];
        EXPECT_NEAR(arrival.turning, *row.of[l], row.b < 6 ? 1e-4 : 1e-5)
            << four_laws[l] << ", b = " << row.b;
      }
    }
  }
}

TEST(Laws, CaptureWhatPassesCloserThanTheClosedFormsSay) {
  for (std::size_t l = 0; l < four_laws.size(); ++l) {
    Physics physics = physics_of(four_laws[l], 1e-9, 0.01);
    physics.max_turning = 1000.0;
    const PlannedSpace space = space_of(physics, {mass_at({0, 0, 0}, standard_gm, physics)});
    for (const double off : {-1e-7, 1e-7}) {
      const double b = finite_capture[l] * (1.0 + off) * m;
      const Arrival arrival = advance_one(space, photon_at({-500, b, 0}, {1, 0, 0}));
      EXPECT_EQ(arrival.fate, off < 0 ? Fate::absorbed : Fate::escaped) << four_laws[l] << off;
      if (off < 0) {
        const double radius = space.masses[0].horizon_radius;
        EXPECT_NEAR(length(arrival.position) / radius, 1.0, 1e-9) << four_laws[l];
      }
    }
  }
}

/// Masses of m = 1 at x = ±3, felt without an end; light from (0, 0.7, 20) along (δ, 0, -1), and
/// its direction where |x|² = 1601.96. By an independent integrator (DOP853, 1e-13).
struct Pass {
  std::string_view law;
  double aside;
  std::optional<Vec3d> direction;  ///< none where it is absorbed
  double turning;
};

TEST(Laws, LeadLightPastTwoMassesAsAnotherIntegratorDoes) {
  const Pass passes[] = {
      {"newton", 0, Vec3d{0, -0.20041004510, -0.97971210762}, 0.2017764392},
      {"newton", 0.45, Vec3d{-0.45155868890, -0.08980975362, -0.88770995186}, 0.8967520912},
      {"newton", 0.05, {}, 0},
      {"newton", 0.25, {}, 0},
      {"einstein", 0, Vec3d{0, -0.27145032762, -0.96245245058}, 0.2748996203},
      {"einstein", 0.05, {}, 0},
      {"einstein", 0.25, {}, 0},
      {"einstein", 0.45, {}, 0},
      {"schwarzschild", 0, Vec3d{0, -0.26543836778, -0.96412783017}, 0.2686585720},
      {"schwarzschild", 0.05, {}, 0},
      {"schwarzschild", 0.25, {}, 0},
      {"schwarzschild", 0.45, {}, 0},
      {"extreme", 0, Vec3d{0, -0.22154302327, -0.97515059803}, 0.2233965304},
      {"extreme", 0.05, Vec3d{0.96676626803, -0.19542923467, -0.16483445404}, 1.4399361773},
      {"extreme", 0.25, {}, 0},
      {"extreme", 0.45, {}, 0}};
  for (const Pass& pass : passes) {
    Physics physics = physics_of(pass.law, 1e-9, 0.0);
    physics.c = 1.0;
    const PlannedSpace space =
        space_of(physics, {mass_at({-3, 0, 0}, 1.0, physics), mass_at({3, 0, 0}, 1.0, physics)},
                 {Sphere{{0, 0, 0}, std::sqrt(1601.96)}});
    const Arrival arrival = advance_one(space, photon_at({0, 0.7, 20}, {pass.aside, 0, -1}));
    if (!pass.direction) {
      EXPECT_EQ(arrival.fate, Fate::absorbed) << pass.law << pass.aside;
      continue;
    }
    ASSERT_EQ(arrival.fate, Fate::hit) << pass.law << pass.aside;
    EXPECT_LT(length(arrival.direction - *pass.direction), 2e-9) << pass.law << pass.aside;
    EXPECT_NEAR(arrival.turning, pass.turning, 2e-9) << pass.law << pass.aside;
  }
}

}  // namespace
}  // namespace portalens::test
