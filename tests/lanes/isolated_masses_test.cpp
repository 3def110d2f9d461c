// Masses that are alone in their influence, crossed by table in lanes, against the scalar engine.
#include "lanes/isolated_masses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/closest_point.h"
#include "support/lanes.h"
#include "support/random.h"
#include "support/scale.h"
#include "support/spaces.h"

namespace portalens::test {
namespace {

constexpr double min_force = 1.0;  // R = 44.7, m = 0.988

Physics isolated_physics(double tolerance = 1e-4) { return physics_with(tolerance, min_force); }

Mass mass_at_origin() { return mass_at({0, 0, 0}, standard_gm, isolated_physics()); }

int isolated_count(const PlannedSpace& space) {
  return space.lanes ? static_cast<int>(space.lanes->isolated.masses.size()) : -1;
}

/// From around `from` into a square about the origin.
std::vector<Photon> photons_from(Vec3d from, double width, int count) {
  Random random(31);
  std::vector<Photon> photons;
  for (int i = 0; i < count; ++i) {
    const Vec3d start = from + random.point(1.0);
    photons.push_back(photon_at(start, random.point(width) - start));
  }
  return photons;
}

/// The largest differences, but for photons whose fates are apart.
struct Apart {
  std::size_t fates = 0;
  double direction = 0, place = 0, length = 0, turning = 0;  ///< lengths as shares of the extent
};

/// Where a path ends, or where it was last next to the middle of all.
Vec3d place_of(const Arrival& arrival) {
  return arrival.fate == Fate::escaped
             ? arrival.position - arrival.direction * dot(arrival.position, arrival.direction)
             : arrival.position;
}
double length_to_place(const Arrival& arrival) {
  return arrival.length -
         (arrival.fate == Fate::escaped ? dot(arrival.position, arrival.direction) : 0.0);
}

Apart compare(const PlannedSpace& lanes, const std::vector<Photon>& photons) {
  Physics fine = lanes.physics;
  fine.tolerance = 1e-8;
  const PlannedSpace exact =
      space_with(fine, lanes.masses, lanes.surfaces.shapes(),
                 {lanes.portals.portals().begin(), lanes.portals.portals().end()});
  std::vector<Arrival> found(photons.size()), expected(photons.size());
  advance(lanes, photons, found);
  advance(exact, photons, expected, Engine::scalar);
  Apart apart;
  for (std::size_t i = 0; i < photons.size(); ++i) {
    const Arrival &a = found[i], &b = expected[i];
    if (a.fate != b.fate || a.met != b.met || a.object != b.object || a.crossings != b.crossings) {
      ++apart.fates;
      continue;
    }
    apart.direction = std::fmax(apart.direction, length(a.direction - b.direction));
    apart.place = std::fmax(apart.place, length(place_of(a) - place_of(b)) / lanes.extent);
    apart.length =
        std::fmax(apart.length, std::fabs(length_to_place(a) - length_to_place(b)) / lanes.extent);
    apart.turning = std::fmax(apart.turning, std::fabs(a.turning - b.turning));
  }
  return apart;
}

void expect_close(const Apart& apart) {
  EXPECT_LE(apart.fates, 1u);
  EXPECT_LT(apart.direction, 3e-5);
  EXPECT_LT(apart.place, 1e-5);
  EXPECT_LT(apart.length, 1e-5);
  EXPECT_LT(apart.turning, 3e-5);
}

TEST(IsolatedMasses, AreCrossedAsTheScalarEngineCrossesThem) {
  const PlannedSpace space = space_with(isolated_physics(), {mass_at_origin()});
  ASSERT_EQ(isolated_count(space), 1);
  for (const double width : {4.0, 12.0, 60.0})
    expect_close(compare(space, photons_from({90, 20, 10}, width, scaled(4000))));
}

TEST(IsolatedMasses, TakeOneStepToCross) {
  const PlannedSpace space = space_with(isolated_physics(), {mass_at_origin()});
  const Photon photon = photon_at({90, 5, 0}, {-1, 0, 0});
  Arrival arrival;
  advance(space, {&photon, 1}, {&arrival, 1});
  EXPECT_EQ(arrival.fate, Fate::escaped);
  EXPECT_EQ(arrival.steps, 1u);
}

TEST(IsolatedMasses, AreCrossedByTwentyInARow) {
  const Physics physics = isolated_physics();
  std::vector<Mass> masses;
  Random random(5);
  for (int i = 0; i < 20; ++i) {
    const double gm = random.uniform(5.0, 20.0);
    masses.push_back(
        mass_at({(i % 5) * 10.0 - 20.0, i / 5 * 10.0 - 15.0, random.uniform(-3, 3)}, gm, physics));
  }
  const PlannedSpace space = space_with(physics, masses);
  ASSERT_EQ(isolated_count(space), 20);
  const Apart apart = compare(space, photons_from({70, 3, 2}, 25.0, scaled(6000)));
  // What one mass does to a way in float, the next ones magnify.
  EXPECT_LE(apart.fates, 2u);
  EXPECT_LT(apart.direction, 3e-4);
  EXPECT_LT(apart.turning, 3e-4);
}

TEST(IsolatedMasses, MayBeBesideOthersThatAreNot) {
  const Physics physics = isolated_physics();
  const std::vector<Mass> masses = {mass_at({-80, 0, 0}, 500, physics),
                                    mass_at({-80, 30, 0}, 500, physics),
                                    mass_at({0, 0, 0}, standard_gm, physics)};
  const PlannedSpace space = space_with(physics, masses);
  ASSERT_EQ(isolated_count(space), 1);
  EXPECT_EQ(space.lanes->mass_of(0), 0u);
  EXPECT_EQ(space.lanes->mass_of(max_lane_masses), 2u);
  const auto photons = photons_from({100, 4, 4}, 30.0, scaled(4000));
  const Apart apart = compare(space, photons);
  EXPECT_LE(apart.fates, 2u);
  EXPECT_LT(apart.direction, 2e-3);  // of the steps through the others, at a tolerance of 1e-4
}

TEST(IsolatedMasses, HaveNoSurfaceInTheirInfluence) {
  const Mass mass = mass_at_origin();
  for (const double off : {-0.02, 0.02}) {
    const double distance = mass.influence + off;
    const Sphere sphere({0, distance + 1.0, 0}, 1.0);
    const Quad wall(std::array<Vec3d, 4>{
        {{-9, -9, -distance}, {9, -9, -distance}, {9, 9, -distance}, {-9, 9, -distance}}});
    const Sphere around({0, 0, 0}, distance);
    for (const Shape& shape : {Shape(sphere), Shape(wall), Shape(around)}) {
      const PlannedSpace space = space_with(isolated_physics(), {mass}, {shape});
      EXPECT_EQ(isolated_count(space), off > 0.0 ? 1 : 0) << off;
      const Apart apart = compare(space, photons_from({0.5, 60, 10}, 50.0, scaled(1500)));
      EXPECT_LE(apart.fates, 2u);
      if (off > 0.0) {
        EXPECT_LT(apart.direction, 3e-5);
      }
    }
  }
}

TEST(IsolatedMasses, HideWhatIsBehindThem) {
  std::vector<Shape> shapes;
  Random random(7);
  for (int i = 0; i < 30; ++i)
    shapes.emplace_back(
        Cube({random.uniform(-80, -60), random.uniform(-50, 50), random.uniform(-50, 50)},
             {6, 6, 6}, {10, 20, 30}));
  for (int i = 0; i < 5; ++i)
    shapes.emplace_back(Sphere({-60.0, random.uniform(-40, 40), random.uniform(-40, 40)}, 6.0));
  const PlannedSpace space = space_with(isolated_physics(), {mass_at_origin()}, shapes);
  ASSERT_EQ(isolated_count(space), 1);
  const auto photons = photons_from({90, 0, 0}, 20.0, scaled(4000));
  const Apart apart = compare(space, photons);
  EXPECT_LE(apart.fates, photons.size() / 500);
  EXPECT_LT(apart.direction, 3e-5);
  EXPECT_LT(apart.turning, 3e-5);
}

TEST(IsolatedMasses, DoNotTouchOneAnother) {
  const Physics physics = isolated_physics();
  const double radius = mass_at_origin().influence;
  for (const double gap : {-0.02, 0.02}) {
    const PlannedSpace space =
        space_with(physics, {mass_at({-radius, 0, 0}, standard_gm, physics),
                             mass_at({radius + gap, 0, 0}, standard_gm, physics)});
    EXPECT_EQ(isolated_count(space), gap > 0.0 ? 2 : 0);
    const Apart apart = compare(space, photons_from({150, 3, 2}, 60.0, scaled(2000)));
    EXPECT_LE(apart.fates, 2u);
    if (gap > 0.0) {
      EXPECT_LT(apart.direction, 2e-4);
    }
  }
}

TEST(IsolatedMasses, AreOutOfEveryPortalsReach) {
  Physics physics = isolated_physics();
  const auto square = [](double x, double turn) {
    return std::vector<Vec3d>{{x, -1, -turn}, {x, -1, turn}, {x, 1, turn}, {x, 1, -turn}};
  };
  const Mass isolated = mass_at_origin();
  const auto pair = portal_pair(square(120, 1), square(140, -1));
  EXPECT_EQ(isolated_count(space_with(physics, {isolated}, {}, pair)), 1);
  EXPECT_EQ(
      isolated_count(space_with(physics, {isolated}, {},
                                portal_pair(square(isolated.influence - 0.1, 1), square(140, -1)))),
      0);
  for (const char* coupling : {"closest-point", "graviton-map", "shortest-path"}) {
    physics.portal_gravity = coupling;
    physics.portal_gravity_depth = 1;
    EXPECT_EQ(isolated_count(space_with(physics, {isolated}, {}, pair)), 1) << coupling;
    // The other mass comes as far as the first.
    const Mass other = mass_at({150, 0, 0}, 60000, physics);
    const auto near = portal_pair(square(isolated.influence + 1.0, 1), square(140 - 245, -1));
    EXPECT_EQ(isolated_count(space_with(physics, {isolated, other}, {}, near)), 0) << coupling;
    // A mass that acts through the portals, beside one that is alone.
    const Mass beside = mass_at({135, 0, 0}, 50, physics);
    const PlannedSpace space = space_with(physics, {isolated, beside}, {}, pair);
    EXPECT_EQ(isolated_count(space), 1) << coupling;
    const Apart apart = compare(space, photons_from({90, 30, 0}, 130.0, scaled(1000)));
    EXPECT_LE(apart.fates, 4u) << coupling;
    EXPECT_LT(apart.direction, 1e-2) << coupling;
  }
}

TEST(IsolatedMasses, HaveNoCoreAndAHorizonWithinAFiniteInfluence) {
  const Physics physics = isolated_physics();
  Mass mass = mass_at_origin();
  mass.core = 1.0;
  EXPECT_EQ(isolated_count(space_with(physics, {mass})), 0);
  mass = mass_at_origin();
  mass.horizon = false;
  EXPECT_EQ(isolated_count(space_with(physics, {mass})), 0);
  const Physics strong = physics_with(1e-4, 1e5);
  EXPECT_EQ(isolated_count(space_with(strong, {mass_at({0, 0, 0}, standard_gm, strong)})), 0);
  // The scalar engine alone takes infinite ones.
  const Physics infinite = physics_with(1e-4, 0.0);
  EXPECT_EQ(isolated_count(space_with(infinite, {mass_at({0, 0, 0}, standard_gm, infinite)})), -1);
}

TEST(IsolatedMasses, AreSeenFromWithinAsTheScalarEngineSeesThem) {
  const PlannedSpace space = space_with(isolated_physics(), {mass_at_origin()});
  for (const double distance : {3.0, 10.0, 44.0, 44.7}) {
    const Apart apart = compare(space, photons_from({0, distance, 0}, 8.0, scaled(500)));
    EXPECT_EQ(apart.fates, 0u);
    EXPECT_LT(apart.direction, 2e-4);
  }
}

TEST(IsolatedMasses, HoldNoViewpoint) {
  const Physics physics = isolated_physics();
  for (const double distance : {10.0, 44.0, 50.0}) {
    const PlannedSpace space(physics, 16, {}, {}, {mass_at_origin()}, Vec3d{0, distance, 0});
    EXPECT_EQ(isolated_count(space), distance > 45.0 ? 1 : 0);
    EXPECT_EQ(space.lanes->stepped.size(), distance > 45.0 ? 0u : 1u);
  }
}

TEST(IsolatedMasses, LeaveLimitsAsTheyAre) {
  const Mass mass = mass_at_origin();
  const std::array<Vec3d, 4> behind = {
      {{-60, -90, -90}, {-60, 90, -90}, {-60, 90, 90}, {-60, -90, 90}}};
  for (int limit = 0; limit < 4; ++limit) {
    Physics physics = isolated_physics();
    if (limit == 0) physics.max_turning = 0.3;
    if (limit == 1) physics.max_length = 100.0;
    if (limit == 2) physics.max_length = 60.0;
    if (limit == 3) physics.max_length = 140.0;
    const PlannedSpace space = space_with(physics, {mass}, {Quad(behind)});
    ASSERT_EQ(isolated_count(space), 1);
    const auto photons = photons_from({90, 0, 0}, 40.0, scaled(500));
    std::vector<Arrival> lanes(photons.size()), scalar(photons.size());
    advance(space, photons, lanes);
    advance(space, photons, scalar, Engine::scalar);
    std::size_t unlike = 0;
    for (std::size_t i = 0; i < photons.size(); ++i)
      unlike += lanes[i].fate != scalar[i].fate ? 1 : 0;
    EXPECT_LE(unlike, 2u) << limit;
  }
}

TEST(IsolatedMasses, AreSteppedThroughBeyondTheirRoom) {
  const Physics physics = isolated_physics();
  std::vector<Mass> masses;
  const auto fill = [&](int count) {
    masses.clear();
    for (int i = 0; i < count; ++i) masses.push_back(mass_at({3.0 * i, 0, 0}, 1.0, physics));
    return space_with(physics, masses);
  };
  EXPECT_EQ(isolated_count(fill(max_lane_isolated_masses + 1)), max_lane_isolated_masses);
  const PlannedSpace more = fill(max_lane_isolated_masses + max_lane_masses + 1);
  EXPECT_EQ(isolated_count(more), 0);
  EXPECT_EQ(more.lanes->scene.many.count, static_cast<int>(more.masses.size()));
}

TEST(IsolatedMasses, AreCrossedWithTheSameBitsByEveryInstructionSet) {
  expect_same_bits_with_every_set(space_with(isolated_physics(), {mass_at_origin()}),
                                  photons_from({90, 20, 10}, 20.0, scaled(3000)));
}

TEST(IsolatedMasses, AreCrossedOnTrailsThatHoldTheWay) {
  const PlannedSpace space = space_with(isolated_physics(1e-5), {mass_at_origin()});
  const auto photons = photons_from({90, 20, 10}, 12.0, scaled(300));
  std::vector<Arrival> arrivals(photons.size());
  std::vector<PathRecord> records(photons.size());
  advance_with_records(space, photons, arrivals, records);
  std::size_t known = 0;
  for (std::size_t i = 0; i < photons.size(); ++i) {
    PathTrace path_trace;
    const Arrival exact = advance_recorded(space, photons[i], path_trace);
    if (!records[i].known()) {
      // Lanes give up no path but one near capture, which magnifies what they round.
      EXPECT_GT(exact.turning, 1.0) << "photon " << i;
      continue;
    }
    ++known;
    const auto points = records[i].points();
    if (exact.fate != arrivals[i].fate) continue;
    // Every place of the path lies in one of the lenses about the straight lines between the
    // points.
    for (const Vec3d& place : path_trace.stretches[0]) {
      double outside = 1e9;
      for (std::size_t k = 1; k < points.size(); ++k) {
        const Waypoint &a = points[k - 1], &b = points[k];
        ASSERT_GT(b.length - a.length, -1e-3);
        ASSERT_GT(b.turning - a.turning, -1e-5);
        const Vec3d nearest = closest_on_segment({a.place.x, a.place.y, a.place.z},
                                                 {b.place.x, b.place.y, b.place.z}, place);
        const double stray = 0.25 * (b.length - a.length) * (b.turning - a.turning);
        outside = std::fmin(outside, length(place - nearest) - stray);
      }
      EXPECT_LT(outside, 1e-3) << "photon " << i;
    }
    // They are spread so that what is near the mass is told closely.
    EXPECT_GE(points.size(), arrivals[i].fate == Fate::absorbed ? 4u : 6u);
  }
  EXPECT_GE(known, photons.size() - photons.size() / 50);
}

}  // namespace
}  // namespace portalens::test
