// Crowds of masses in lanes, against the scalar engine.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "support/lanes.h"
#include "support/random.h"
#include "support/scale.h"
#include "support/spaces.h"

namespace portalens::test {
namespace {

constexpr double weak_force = 10.0;  // the horizon of a sphere of influence of radius R is R²/101
constexpr double half = 10.0;        // of the box in which they are

/// What many masses is like.
struct Kind {
  const char* name;
  int count;
  double spheres;          ///< mean number of spheres of influence over a place in the box
  double spread = 1.0;     ///< the largest radius of a sphere to the least
  double with_core = 0.0;  ///< share of those without a horizon
  int giants = 0;          ///< spheres as large as the box
  bool objects = false;    ///< surfaces and portals among them
};

Mass mass_of(Vec3d center, double radius, const Physics& physics) {
  return mass_at(center, physics.min_force * radius * radius, physics);
}

std::vector<Mass> masses_of(const Kind& kind, const Physics& physics, std::uint64_t seed) {
  Random random(seed);
  std::vector<Mass> masses;
  const double volume = 8.0 * half * half * half;
  const double usual = std::cbrt(kind.spheres * volume / (4.19 * kind.count));
  for (int i = 0; i < kind.count; ++i) {
    const double radius = usual * std::pow(kind.spread, random.uniform(-0.5, 0.5));
    masses.push_back(mass_of(random.point(half), radius, physics));
    if (random.uniform(0.0, 1.0) < kind.with_core) {
      masses.back().horizon = false;
      masses.back().core = 0.1 * radius;
    }
  }
  for (int i = 0; i < kind.giants; ++i)
    masses.insert(masses.begin() + random.bits() % masses.size(),
                  mass_of(random.point(half), 1.5 * half, physics));
  return masses;
}

PlannedSpace space_of(const Kind& kind, Physics physics, std::uint64_t seed) {
  std::vector<Shape> shapes;
  std::vector<Portal> portals;
  if (kind.objects) {
    Random random(seed + 1);
    for (int i = 0; i < 6; ++i) shapes.emplace_back(Sphere(random.point(half), 1.5));
    shapes.emplace_back(Quad(std::array<Vec3d, 4>{
        {{-half, -half, half}, {half, -half, half}, {half, -half, -half}, {-half, -half, -half}}}));
    portals = portal_pair({{-4, -4, 2}, {4, -4, 2}, {4, 4, 2}, {-4, 4, 2}},
                          {{30, -4, 2}, {38, -4, 2}, {38, 4, 2}, {30, 4, 2}});
  }
  return space_with(physics, masses_of(kind, physics, seed), std::move(shapes), std::move(portals));
}

/// Towards the box from outside, and from places within it.
std::vector<Photon> photons_about(int count, std::uint64_t seed) {
  Random random(seed + 2);
  std::vector<Photon> photons;
  for (int i = 0; i < count; ++i) {
    const Vec3d start = i % 3 == 0 ? random.point(half) : Vec3d{3, 4, 4.0 * half};
    photons.push_back(photon_at(start, random.point(half) - start));
  }
  return photons;
}

const Kind kinds[] = {{"ThatIsSmall", 9, 2.0},
                      {"ThatIsThin", 200, 0.05},
                      {"ThatIsThick", 100, 10.0, 3.0, 0.9},
                      {"OfAllSizes", 200, 1.0, 10.0, 0.3},
                      {"ThatIsLarge", 2000, 1.0},
                      {"UnderGiants", 500, 0.3, 2.0, 0.0, 3},
                      {"AmongObjects", 100, 1.0, 2.0, 0.2, 0, true}};

struct ManyMassesIn : testing::TestWithParam<Kind> {};

std::vector<Arrival> by_scalar(const PlannedSpace& space, const std::vector<Photon>& photons) {
  std::vector<Arrival> arrivals(photons.size());
  advance(space, photons, arrivals, Engine::scalar);
  return arrivals;
}

/// The errors of those that met the same, ascending, and how many did not.
struct Errors {
  std::vector<double> direction;
  int unlike = 0;

  Errors(const std::vector<Arrival>& found, const std::vector<Arrival>& exact) {
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Arrival &a = found[i], &b = exact[i];
      if (a.fate != b.fate || a.met != b.met || a.object != b.object || a.crossings != b.crossings)
        ++unlike;
      else
        direction.push_back(length(a.direction - b.direction));
    }
    std::sort(direction.begin(), direction.end());
  }
  [[nodiscard]] double at(double share) const {
    return direction[static_cast<std::size_t>(share * (direction.size() - 1.0))];
  }
};

TEST_P(ManyMassesIn, LanesLandWhereTheScalarEngineHasThem) {
  const Kind& kind = GetParam();
  const int count = scaled(500);
  for (const std::uint64_t seed : {1, 2}) {
    const PlannedSpace space = space_of(kind, physics_with(1e-4, weak_force), seed);
    ASSERT_TRUE(space.lanes);
    ASSERT_GT(space.lanes->scene.many.count, 0);
    const auto photons = photons_about(count, seed);
    const auto exact = by_scalar(space_of(kind, physics_with(1e-8, weak_force), seed), photons);
    const Errors scalar(by_scalar(space, photons), exact);
    const Errors lanes(in_lanes(space, photons, lane_engine().name), exact);
    EXPECT_LE(lanes.unlike, 2 * scalar.unlike + 2);
    // Of a dense cluster the scalar engine takes most paths again, in finer steps. In one go its
    // median is 8e-6.
    const double in_one_go = kind.spheres >= 10.0 ? 8e-6 : 0.0;
    EXPECT_LT(lanes.at(0.5), std::max(3.0 * scalar.at(0.5) + 2e-6, in_one_go));
    EXPECT_LT(lanes.at(0.9), 4.0 * scalar.at(0.9) + 1e-5);
  }
}

TEST_P(ManyMassesIn, LanesGiveTheSameBitsWithEveryInstructionSetAndInAnyOrder) {
  const Kind& kind = GetParam();
  const PlannedSpace space = space_of(kind, physics_with(1e-4, weak_force), 3);
  const auto photons = photons_about(scaled(400), 3);
  const auto expected = in_lanes(space, photons, lane_engine().name);
  std::vector<std::size_t> order(photons.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  Random random(4);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.bits() % i]);
  std::vector<Photon> shuffled;
  for (const std::size_t i : order) shuffled.push_back(photons[i]);
  for (const char* isa : {"sse4", "avx2", "avx512"}) {
    if (!lane_engine(isa).step) continue;
    const auto arrivals = in_lanes(space, shuffled, isa);
    for (std::size_t i = 0; i < order.size(); ++i)
      expect_same(arrivals[i], expected[order[i]], order[i]);
  }
  for (std::size_t i = 0; i < photons.size(); i += 5)
    expect_same(in_lanes(space, {photons[i]}, lane_engine().name)[0], expected[i], i);
}

TEST(ManyMasses, IsBesideMassesThatAreAlone) {
  const Physics physics = physics_with(1e-4, weak_force);
  std::vector<Mass> masses = masses_of({"", 20, 3.0}, physics, 5);
  for (int i = 0; i < 10; ++i)
    masses.insert(masses.begin() + 2 * i, mass_of({40.0 + 4.0 * i, 0, 0}, 1.9, physics));
  const PlannedSpace space = space_with(physics, masses);
  ASSERT_TRUE(space.lanes);
  EXPECT_EQ(space.lanes->scene.isolated_count, 10);
  EXPECT_EQ(space.lanes->scene.many.count, 20);
  for (const std::uint32_t mass : {0u, 7u, 25u}) {
    // Into its horizon, from close by.
    const Vec3d center = masses[mass].center;
    const Photon photon = photon_at(center + Vec3d{0, 0, 0.3}, {0.0, 0.0, -1.0});
    const Arrival arrival = in_lanes(space, {photon}, lane_engine().name)[0];
    EXPECT_EQ(arrival.fate, Fate::absorbed);
    EXPECT_EQ(arrival.object, mass);
  }
}

TEST(ManyMasses, AbsorbsWhereHorizonsAreLargerThanInfluences) {
  const Physics physics = physics_with(1e-4, 2000.0);
  Random random(6);
  std::vector<Mass> masses;
  for (int i = 0; i < 60; ++i) masses.push_back(mass_of(random.point(half), 1.0, physics));
  const PlannedSpace space = space_with(physics, masses);
  ASSERT_TRUE(space.lanes);
  ASSERT_GT(masses[0].horizon_radius, 1.5 * masses[0].influence);
  const auto photons = photons_about(scaled(1000), 6);
  const auto lanes = in_lanes(space, photons, lane_engine().name);
  const auto scalar = by_scalar(space, photons);
  int unlike = 0;
  for (std::size_t i = 0; i < photons.size(); ++i) {
    if (lanes[i].fate != scalar[i].fate || lanes[i].object != scalar[i].object) {
      ++unlike;
    } else if (lanes[i].fate == Fate::absorbed) {
      EXPECT_LT(length(lanes[i].position - scalar[i].position), 1e-3) << i;
    }
  }
  EXPECT_LE(unlike, 1);
}

TEST(ManyMasses, KeepsTheLimits) {
  for (const bool of_steps : {true, false}) {
    Physics physics = physics_with(1e-4, weak_force);
    (of_steps ? physics.max_steps = 20 : physics.max_length = 47.0);
    const PlannedSpace space = space_of({"", 300, 2.0}, physics, 7);
    ASSERT_TRUE(space.lanes);
    const auto photons = photons_about(300, 7);
    std::size_t lost = 0;
    for (const Arrival& arrival : in_lanes(space, photons, lane_engine().name)) {
      lost += arrival.fate == Fate::lost ? 1 : 0;
      EXPECT_LE(arrival.steps, physics.max_steps + 1);
    }
    EXPECT_GT(lost, photons.size() / 10);
    EXPECT_LT(lost, photons.size() * 9 / 10);
  }
}

TEST(ManyMasses, LeavesToTheScalarEngineWhereThereAreTooMany) {
  // Beyond `max_lane_near`, no place may lie in more than `max_lane_own`.
  const Physics physics = physics_with(1e-3, weak_force);
  Random random(8);
  std::vector<Mass> masses;
  for (int i = 0; i < max_lane_near; ++i)
    masses.push_back(mass_of(Vec3d{-8, 0, 0} + random.point(0.5), 0.05, physics));
  for (int i = 0; i <= max_lane_own; ++i)
    masses.push_back(mass_of(Vec3d{8, 0, 0} + random.point(0.01), 1.0, physics));
  const PlannedSpace space = space_with(physics, masses);
  ASSERT_TRUE(space.lanes);
  std::vector<Photon> photons;
  for (int i = 0; i < 40; ++i)
    photons.push_back(photon_at({8, 3, 3}, random.point(0.7) - Vec3d{0, 3, 3}));
  const auto lanes = in_lanes(space, photons, lane_engine().name);
  const auto scalar = by_scalar(space, photons);
  for (std::size_t i = 0; i < photons.size(); ++i) {
    ASSERT_EQ(lanes[i].fate, scalar[i].fate);
    EXPECT_LT(length(lanes[i].direction - scalar[i].direction), 2e-3);
    expect_same(in_lanes(space, {photons[i]}, lane_engine().name)[0], lanes[i], i);
  }
}

TEST(ManyMasses, MayHavePortalsThatActAsMassesAndNoneThatAreLookedThrough) {
  for (const auto& [coupling, takes] : {std::pair("portal-mass", true),
                                        {"closest-point", false},
                                        {"graviton-map", false},
                                        {"shortest-path", false}}) {
    Physics physics = physics_with(1e-4, weak_force);
    physics.portal_gravity = coupling;
    const PlannedSpace space = space_of({"", 12, 2.0, 1.0, 0.0, 0, true}, physics, 10);
    EXPECT_EQ(static_cast<bool>(space.lanes), takes) << coupling;
    if (!takes) continue;
    EXPECT_EQ(space.lanes->scene.many.count, 14);
    const auto photons = photons_about(scaled(300), 10);
    const Errors errors(in_lanes(space, photons, lane_engine().name), by_scalar(space, photons));
    EXPECT_LE(errors.unlike, static_cast<int>(photons.size() / 50));
    EXPECT_LT(errors.at(0.5), 1e-4);
  }
}

TEST(ManyMasses, MayLieAllAtOnePlaceOrUnderOneGiant) {
  const Physics physics = physics_with(1e-3, weak_force);
  std::vector<Mass> heap(max_lane_many, mass_of({0, 0, 0}, 1e-3, physics));
  const PlannedSpace at_one_place = space_with(physics, heap);
  EXPECT_TRUE(at_one_place.lanes);
  heap.push_back(heap.front());
  EXPECT_FALSE(space_with(physics, heap).lanes);

  std::vector<Mass> masses = masses_of({"", 10000, 0.1}, physics, 9);
  masses.push_back(mass_of({0, 0, 0}, 1000.0 * half, physics));
  const PlannedSpace under_a_giant = space_with(physics, masses);
  ASSERT_TRUE(under_a_giant.lanes);
  for (const PlannedSpace* space : {&at_one_place, &under_a_giant}) {
    const LaneManyMasses& many = space->lanes->scene.many;
    const int cells = many.cells_x * many.cells_y * many.cells_z;
    EXPECT_LE(many.begins[cells], 1u << 20);
    EXPECT_LE(cells, 1 << 18);
  }
  EXPECT_EQ(in_lanes(at_one_place, {photon_at({0, 1, 5}, {0, 0, -1})}, lane_engine().name)[0].fate,
            Fate::escaped);
}

INSTANTIATE_TEST_SUITE_P(, ManyMassesIn, testing::ValuesIn(kinds),
                         [](const auto& kind) { return std::string(kind.param.name); });

TEST(ManyMasses, LiesWhereNothingActsAnywhere) {
  const Physics physics = physics_with(1e-4, 1e300);
  const std::vector<Mass> masses(12, mass_at({1, 2, 3}, 1e-60, physics));
  const PlannedSpace space = space_with(physics, masses, {}, {});
  const auto photons = photons_about(40, 1);
  std::vector<Arrival> arrivals(photons.size());
  advance(space, photons, arrivals);
  for (std::size_t i = 0; i < photons.size(); ++i) {
    EXPECT_EQ(arrivals[i].fate, Fate::escaped);
    EXPECT_EQ(arrivals[i].direction, photons[i].direction);
  }
}

}  // namespace
}  // namespace portalens::test
