// Photons in lanes through portals that are no rectangles, against the scalar engine, each other,
// and instruction sets among themselves.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string_view>

#include "support/faces.h"
#include "support/lanes.h"
#include "support/random.h"
#include "support/scale.h"
#include "support/spaces.h"

namespace portalens::test {
namespace {

/// A corner in the plane of a portal.
struct Corner {
  double x, y;
};
using Corners = std::vector<Corner>;

const Corners triangle = {{-1.1, -0.7}, {1.2, -0.8}, {-0.3, 1.1}};
const Corners trapezium = {{-1.3, -0.8}, {1.2, -0.8}, {0.6, 0.9}, {-0.5, 0.9}};
const Corners pentagon = {{-0.9, -0.9}, {0.7, -1.0}, {1.2, 0.2}, {0.1, 1.1}, {-1.1, 0.3}};
const Corners rectangle = {{-1.0, -0.8}, {1.0, -0.8}, {1.0, 0.8}, {-1.0, 0.8}};

const Corners star = {{1.2, 0}, {0.35, 0.4}, {-0.6, 1.0}, {-0.5, 0.0}, {-0.6, -1.0}, {0.35, -0.4}};

Corners regular(int count) {
  Corners corners;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * M_PI * i / count + 0.2;
    corners.push_back({1.1 * std::cos(angle), 1.1 * std::sin(angle)});
  }
  return corners;
}

/// A plane in space, as tilted as two angles say.
Frame plane(Vec3d origin, double turn, double tilt, double roll = 0.0) {
  const Vec3d right{std::cos(turn), 0, -std::sin(turn)}, back{std::sin(turn), 0, std::cos(turn)};
  const Vec3d up = Vec3d{0, 1, 0} * std::cos(tilt) - back * std::sin(tilt);
  const Vec3d x = right * std::cos(roll) + up * std::sin(roll);
  const Vec3d y = up * std::cos(roll) - right * std::sin(roll);
  return {origin, x, y, cross(x, y)};
}

std::vector<Portal> pair_of(const Corners& corners, const Frame& a, const Frame& b) {
  std::vector<Vec3d> here, there;
  const std::size_t count = corners.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Corner &own = corners[i], &mirrored = corners[(count + 1 - i) % count];
    here.push_back(a.to_world({own.x, own.y, 0.0}));
    there.push_back(b.to_world({-mirrored.x, mirrored.y, 0.0}));
  }
  return portal_pair(here, there);
}

/// Two ellipses.
struct Radii {
  double x, y;
};
std::vector<Portal> pair_of(Radii radii, const Frame& a, const Frame& b) {
  std::vector<Portal> portals(2);
  give_face(portals[0], ellipse_input(a, radii.x, radii.y));
  give_face(portals[1], ellipse_input(b, radii.x, radii.y));
  for (std::uint32_t i = 0; i < 2; ++i) portals[i].pair = 1 - i;
  for (int i = 0; i < 2; ++i)
    portals[i].passage = RigidPassage(motion_through(portals[i].frame, portals[1 - i].frame));
  return portals;
}

void append(std::vector<Portal>& portals, std::vector<Portal> more) {
  const auto count = static_cast<std::uint32_t>(portals.size());
  for (Portal& portal : more) {
    portal.pair += count;
    portals.push_back(std::move(portal));
  }
}

struct Case {
  const char* name;
  Corners corners;  ///< none of an ellipse
  const char* coupling;
  int depth;
  Radii radii = {1.1, 1.1};

  friend std::ostream& operator<<(std::ostream& out, const Case& its) {
    return out << its.name << ' ' << its.coupling << ' ' << its.depth;
  }
};

/// A ground, spheres, two masses, and slanted portals.
PlannedSpace space_of(const char* coupling, int depth, std::vector<Portal> portals,
                      double min_force = 1.0) {
  Physics physics = physics_with(1e-4, min_force);
  physics.portal_gravity = coupling;
  physics.portal_gravity_depth = depth;
  physics.max_steps = 20000;
  std::vector<Shape> shapes;
  const std::array<Vec3d, 4> ground = {{{-30, 0, 30}, {30, 0, 30}, {30, 0, -30}, {-30, 0, -30}}};
  shapes.emplace_back(Quad(ground));
  Random random(31);
  for (int i = 0; i < 3; ++i)
    shapes.emplace_back(Sphere({random.uniform(-5, 5), 1.0, random.uniform(-6, 0)}, 0.7));
  return space_with(physics,
                    {mass_at({-3, 1.5, 0.5}, 300, physics), mass_at({4, 3, 1.5}, 120, physics)},
                    std::move(shapes), std::move(portals));
}

PlannedSpace space_of(const Case& its) {
  const Frame a = plane({-3, 1.6, -2}, 0.3, 0.2, 0.1), b = plane({3.5, 1.9, -3}, -0.5, -0.1, -0.2);
  return space_of(its.coupling, its.depth,
                  its.corners.empty() ? pair_of(its.radii, a, b) : pair_of(its.corners, a, b));
}

/// From before the portals, from behind and beside them.
std::vector<Photon> photons_from_all_sides(int count) {
  Random random(32);
  const Vec3d from[] = {{0, 2, 12}, {-5, 3, -12}, {5, 2, -12}, {14, 4, -2}, {-3, 8, 1}};
  std::vector<Photon> photons;
  for (int i = 0; i < count; ++i) {
    const Vec3d at = from[i * 5 / count];
    const Vec3d towards = Vec3d{0, 1.7, -2} + Vec3d{random.uniform(-6, 6), random.uniform(-2, 3),
                                                    random.uniform(-4, 4)};
    photons.push_back(photon_at(at, towards - at));
  }
  return photons;
}

/// @param deep  what comes through many portals in a row adds up, and so do its errors; behind the
///              middle of a circle neighbours part
void expect_as_scalar(const PlannedSpace& space, const std::vector<Photon>& photons, bool deep) {
  ASSERT_TRUE(space.lanes);
  ASSERT_NE(lane_engine().step, nullptr);
  std::vector<Arrival> lanes(photons.size()), scalar(photons.size());
  advance(space, photons, lanes);
  advance(space, photons, scalar, Engine::scalar);
  std::vector<double> apart;
  std::size_t unlike = 0, crossed = 0;
  for (std::size_t i = 0; i < photons.size(); ++i) {
    const Arrival &a = lanes[i], &b = scalar[i];
    if (b.crossings > 0) ++crossed;
    if (a.fate != b.fate || a.object != b.object || a.crossings != b.crossings)
      ++unlike;
    else if (a.fate == Fate::escaped)
      apart.push_back(length(a.direction - b.direction));
    else
      apart.push_back(length(a.position - b.position) / (1.0 + b.length));
  }
  std::sort(apart.begin(), apart.end());
  EXPECT_GT(crossed, photons.size() / 100);
  EXPECT_LT(static_cast<double>(unlike), 0.003 * static_cast<double>(photons.size()) + 2);
  EXPECT_LT(apart[apart.size() / 2], deep ? 1e-4 : 3e-5);
  EXPECT_LT(apart[apart.size() * 98 / 100], deep ? 1e-3 : 4e-4);
}

class LanesThroughPolygons : public testing::TestWithParam<Case> {};

TEST_P(LanesThroughPolygons, AgreeWithTheScalarEngineWithinFloatButForFewPhotons) {
  // At any scale so many that enough of them cross a narrow portal, too.
  expect_as_scalar(space_of(GetParam()), photons_from_all_sides(std::max(scaled(2500), 1000)),
                   GetParam().depth > 2 || GetParam().corners.empty());
}

TEST_P(LanesThroughPolygons, GiveTheSameBitsWithEveryInstructionSet) {
  expect_same_bits_with_every_set(space_of(GetParam()), photons_from_all_sides(scaled(1000)));
}

TEST_P(LanesThroughPolygons, APhotonsAnswerDoesNotDependOnItsNeighbours) {
  const PlannedSpace space = space_of(GetParam());
  ASSERT_TRUE(space.lanes);
  const auto photons = photons_from_all_sides(scaled(1000));
  const auto together = in_lanes(space, photons, lane_engine().name);
  for (std::size_t i = 0; i < photons.size(); i += 3) {
    const auto alone = in_lanes(space, {photons[i]}, lane_engine().name);
    ASSERT_EQ(alone[0].position, together[i].position) << i;
    ASSERT_EQ(alone[0].turning, together[i].turning) << i;
    ASSERT_EQ(alone[0].steps, together[i].steps) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, LanesThroughPolygons,
    testing::Values(
        Case{"triangle", triangle, "none", 0}, Case{"triangle", triangle, "closest-point", 1},
        Case{"triangle", triangle, "closest-point", 3},
        Case{"trapezium", trapezium, "closest-point", 2},
        Case{"pentagon", pentagon, "portal-mass", 1},
        Case{"pentagon", pentagon, "closest-point", 1},
        Case{"hexagon", regular(6), "closest-point", 2},
        Case{"octagon", regular(8), "closest-point", 1},
        Case{"nearly round", regular(40), "closest-point", 1}, Case{"circle", {}, "portal-mass", 1},
        Case{"circle", {}, "closest-point", 1}, Case{"wide", {}, "closest-point", 1, {1.4, 0.8}},
        Case{"tall", {}, "closest-point", 1, {0.4, 1.5}},
        Case{"triangle", triangle, "shortest-path", 1}, Case{"star", star, "shortest-path", 1},
        Case{"nearly round", regular(40), "shortest-path", 1},
        Case{"triangle", triangle, "graviton-map", 1}, Case{"star", star, "graviton-map", 1},
        Case{"pentagon", pentagon, "graviton-map", 2}, Case{"circle", {}, "graviton-map", 1},
        Case{"tall", {}, "graviton-map", 1, {0.6, 1.5}}));

TEST(LanesThroughPolygons, TakeRectanglesAndOthersTogether) {
  std::vector<Portal> portals =
      pair_of(rectangle, plane({-3, 1.6, -2}, 0.3, 0.2), plane({3.5, 1.9, -3}, -0.5, -0.1));
  append(portals, pair_of(regular(5), plane({0, 4, -4}, 0.1, -0.4), plane({-1, 2, 3}, 2.5, 0.1)));
  const PlannedSpace space = space_of("closest-point", 1, portals);
  ASSERT_TRUE(space.lanes);
  EXPECT_EQ(space.lanes->scene.gate_count, 4);
  expect_as_scalar(space, photons_from_all_sides(scaled(2500)), false);
}

/// Their influence ends somewhere on the faces, and behind one portal the other is out of reach.
TEST(LanesThroughPolygons, SeeMassesBeginAndCeaseToActThroughThem) {
  for (const Corners& corners : {trapezium, rectangle}) {
    const PlannedSpace space = space_of("closest-point", 2,
                                        pair_of(corners, plane({-3, 1.6, -2}, 0.3, 0.2, 0.1),
                                                plane({3.5, 1.9, -3}, -0.5, -0.1, -0.2)),
                                        4.0);
    ASSERT_TRUE(space.lanes);
    const LaneScene& scene = space.lanes->scene;
    EXPECT_TRUE(std::any_of(scene.gates, scene.gates + scene.gate_count,
                            [](const LaneGate& gate) { return gate.fades[0] || gate.fades[1]; }));
    EXPECT_TRUE(std::any_of(scene.gates, scene.gates + scene.gate_count,
                            [](const LaneGate& gate) { return gate.falls_short; }));
    expect_as_scalar(space, photons_from_all_sides(scaled(2500)), false);
  }
}

/// Where a float puts it may be a little behind the portal that it comes from.
TEST(LanesThroughPolygons, LeaveAFrontWhoseBackIsASurfaceWithoutMeetingThat) {
  for (const Corners& corners : {triangle, rectangle}) {
    std::vector<Portal> portals = pair_of(corners, plane({-3, 1.6, -2}, 0.3, 0.2, 0.1),
                                          plane({3.5, 1.9, -3}, -0.5, -0.1, -0.2));
    for (Portal& portal : portals) portal.back_material = 0;
    expect_as_scalar(space_of("none", 0, portals), photons_from_all_sides(scaled(2500)), false);
  }
}

/// What pulls through a portal ends steps at its plane, behind it too.
TEST(LanesThroughPolygons, MeetABackWhereAStepEndsCloseBehindIt) {
  for (const Corners& corners : {triangle, rectangle}) {
    std::vector<Portal> portals = pair_of(corners, plane({-3, 1.6, -2}, 0.3, 0.2, 0.1),
                                          plane({3.5, 1.9, -3}, -0.5, -0.1, -0.2));
    for (Portal& portal : portals) portal.back_material = 0;
    const PlannedSpace space = space_of("closest-point", 1, portals);
    Random random(33);
    std::vector<Photon> photons;
    for (int i = 0; i < scaled(4000); ++i) {
      const Frame& frame = portals[i % 2].frame;
      const Vec3d at = frame.to_world({random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4), 0.0});
      const Vec3d from = frame.to_world(
          {random.uniform(-9, 9), random.uniform(-2, 9), random.uniform(-2.0, -0.3)});
      photons.push_back(photon_at(from, at - from));
    }
    std::vector<Arrival> lanes(photons.size()), scalar(photons.size());
    advance(space, photons, lanes);
    advance(space, photons, scalar, Engine::scalar);
    std::size_t met = 0, missed = 0;
    for (std::size_t i = 0; i < photons.size(); ++i) {
      if (scalar[i].met != Met::portal_back) continue;
      ++met;
      if (lanes[i].met != Met::portal_back) ++missed;
    }
    EXPECT_GT(met, photons.size() / 5);
    EXPECT_LE(missed, photons.size() / 1000);
  }
}

TEST(LanesThroughPolygons, SeeMassesBeginAndCeaseToActThroughEllipses) {
  const Frame a = plane({-3, 1.6, -2}, 0.3, 0.2), b = plane({3.5, 1.9, -3}, -0.5, -0.1);
  for (const Radii radii : {Radii{1.3, 1.3}, Radii{1.5, 0.7}})
    for (const double min_force : {3.0, 10.0, 20.0})
      expect_as_scalar(space_of("closest-point", 1, pair_of(radii, a, b), min_force),
                       photons_from_all_sides(scaled(2500)), true);
}

TEST(LanesThroughPolygons, TakeEllipsesBesidePolygonsButNoneInARow) {
  const Frame a = plane({-3, 1.6, -2}, 0.3, 0.2), b = plane({3.5, 1.9, -3}, -0.5, -0.1);
  EXPECT_FALSE(space_of("closest-point", 2, pair_of(Radii{1.0, 1.0}, a, b)).lanes);
  std::vector<Portal> portals = pair_of(Radii{1.2, 0.9}, a, b);
  append(portals, pair_of(rectangle, plane({0, 4, -4}, 0.1, -0.4), plane({-1, 2, 3}, 2.5, 0.1)));
  append(portals, pair_of(pentagon, plane({-6, 2, -1}, 0.4, 0.1), plane({6, 3, 0}, -0.7, 0.2)));
  const PlannedSpace space = space_of("closest-point", 1, portals);
  ASSERT_TRUE(space.lanes);
  expect_as_scalar(space, photons_from_all_sides(scaled(2500)), true);
}

/// What acts through a back does so as through another portal in its place that faces the other
/// way.
TEST(LanesThroughPolygons, TakeThoseOfTwoSides) {
  const Frame a = plane({-3, 1.6, -2}, 0.3, 0.2), b = plane({3.5, 1.9, -3}, -0.5, -0.1);
  for (const char* coupling : {"closest-point", "graviton-map", "shortest-path"})
    for (const bool round : {false, true}) {
      if (round && std::string_view(coupling) == "shortest-path") continue;
      SCOPED_TRACE(coupling);
      std::vector<Portal> portals =
          round ? pair_of(Radii{1.2, 0.9}, a, b) : pair_of(pentagon, a, b);
      for (Portal& portal : portals) portal.two_sided = true;
      const PlannedSpace space = space_of(coupling, 1, portals);
      ASSERT_TRUE(space.lanes) << space.no_lanes_because;
      expect_as_scalar(space, photons_from_all_sides(scaled(1000)), true);
    }
}

TEST(LanesThroughPolygons, LeaveManyEdgesToTheScalarEngine) {
  const Frame a = plane({-3, 1.6, -2}, 0.3, 0.2), b = plane({3.5, 1.9, -3}, -0.5, -0.1);
  EXPECT_TRUE(space_of("closest-point", 1, pair_of(regular(max_lane_edges), a, b)).lanes);
  EXPECT_FALSE(space_of("closest-point", 1, pair_of(regular(max_lane_edges + 1), a, b)).lanes);
}

}  // namespace
}  // namespace portalens::test
