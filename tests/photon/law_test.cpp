// Light under every law: the closed forms of one mass, several masses, and what all media keep.
#include "gravity/law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "support/lanes.h"
#include "support/random.h"
#include "support/scale.h"
#include "support/spaces.h"

namespace portalens::test {
namespace {

Physics physics_of(std::string_view law, double tolerance, double min_force) {
  Physics physics = physics_with(tolerance, min_force);
  physics.law = law;
  physics.max_length = 1e9;
  return physics;
}

PlannedSpace space_of(const Physics& physics, std::vector<Mass> masses,
                      std::vector<Shape> shapes = {}, std::vector<Portal> portals = {}) {
  set_horizons(make_law(physics.law), masses, physics.c);
  return space_with(physics, std::move(masses), std::move(shapes), std::move(portals));
}

/// One hole of m = 1 in the origin, felt without an end.
PlannedSpace one_hole(std::string_view law, double tolerance) {
  Physics physics = physics_of(law, tolerance, 0.0);
  physics.c = 1.0;
  return space_of(physics, {mass_at({0, 0, 0}, 1.0, physics)});
}

template <class L>
class LightUnder : public testing::Test {};

template <class Variant>
struct TypesOf;
template <class... Types>
struct TypesOf<std::variant<Types...>> {
  using type = testing::Types<Types...>;
};
TYPED_TEST_SUITE(LightUnder, TypesOf<Law>::type);

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

PlannedSpace standard_hole(std::string_view law, double tolerance) {
  const Physics physics = physics_of(law, tolerance, 0.01);
  return space_of(physics, {mass_at({0, 0, 0}, standard_gm, physics)});
}
const double m = standard_gm / (45.0 * 45.0);

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
