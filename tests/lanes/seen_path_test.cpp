// Steps whose paths may meet cubes, cones, cylinders, rings and meshes: taken in lanes, and looked
// along in double.
#include "lanes/seen_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/lanes.h"
#include "support/random.h"
#include "support/scale.h"
#include "support/spaces.h"

namespace portalens::test {
namespace {

/// Two triangles, a wall at x = -4.
Mesh wall() {
  Triangles triangles;
  triangles.positions = {{-4, -3, -3}, {-4, 3, -3}, {-4, 3, 3}, {-4, -3, 3}};
  const auto corner = [](std::uint32_t i) { return Triangles::Corner{i, 0, 0}; };
  triangles.corners = {{corner(0), corner(1), corner(2)}, {corner(0), corner(2), corner(3)}};
  return Mesh(triangles);
}

/// One of each kind about a mass, and a pair of portals, one of them flush in the wall.
PlannedSpace space_about(double gm, double tolerance) {
  Physics physics = physics_with(tolerance, 0.05);
  physics.max_steps = 20000;
  std::vector<Shape> shapes;
  shapes.emplace_back(Cube({3, 0.5, -1}, {1, 1.5, 1}, {0, 30, 0}));
  shapes.emplace_back(Cone({2, 1, 2}, 1.5, 0.8, {20, 0, 10}));
  shapes.emplace_back(Cylinder({-1, -3, 2}, 1.2, 0.7, {0, 0, 40}));
  shapes.emplace_back(Ring({0, 2.5, -2}, 0.3, 0.8, 1.4, {60, 0, 0}));
  shapes.emplace_back(wall());
  auto portals = portal_pair({{-4, -1, 1}, {-4, -1, -1}, {-4, 1, -1}, {-4, 1, 1}},
                             {{5, -1, -1}, {5, -1, 1}, {5, 1, 1}, {5, 1, -1}});
  return space_with(physics, {mass_at({0, 0, 0}, gm, physics)}, std::move(shapes),
                    std::move(portals));
}

std::vector<Photon> photons_towards_the_middle(int count) {
  Random random(41);
  std::vector<Photon> photons;
  for (int i = 0; i < count; ++i) {
    const Vec3d from = random.direction() * random.uniform(6, 15);
    photons.push_back(photon_at(from, random.point(4.0) - from));
  }
  return photons;
}

TEST(SeenPath, StepsNearShapesStayInLanesAndMeetWhatTheScalarEngineMeets) {
  const auto photons = photons_towards_the_middle(scaled(8000));
  for (const double gm : {0.0, 20.0, 400.0}) {
    const PlannedSpace space = space_about(gm, 1e-4);
    ASSERT_TRUE(space.lanes) << space.no_lanes_because;
    ASSERT_EQ(space.lanes->boxed.size(), 5u);
    std::vector<Arrival> lanes(photons.size()), exact(photons.size());
    advance(space, photons, lanes);
    advance(space_about(gm, 1e-8), photons, exact, Engine::scalar);
    std::uint64_t steps = 0, handed_over = 0;
    std::size_t unlike = 0, hits = 0, off = 0;
    for (std::size_t i = 0; i < photons.size(); ++i) {
      const Arrival &a = lanes[i], &b = exact[i];
      steps += a.steps;
      handed_over += a.handed_over;
      if (a.fate != b.fate || a.object != b.object || a.face != b.face ||
          a.crossings != b.crossings) {
        ++unlike;
        continue;
      }
      hits += a.fate == Fate::hit ? 1 : 0;
      if (a.fate == Fate::absorbed) continue;
      off += length(a.direction - b.direction) > 1e-4 ? 1 : 0;
      if (a.fate != Fate::hit) continue;
      // The place slides along what it lies on where the path grazes that.
      off += length(a.position - b.position) > 1e-3 * (1.0 + b.length) ? 1 : 0;
    }
    EXPECT_GT(hits, photons.size() / 5) << gm;
    EXPECT_LE(unlike, photons.size() / 1000 + 1) << gm;
    EXPECT_LE(off, photons.size() / 500) << gm;
    EXPECT_LT(handed_over, steps / 50) << gm;
  }
}

TEST(SeenPath, EveryInstructionSetSeesTheSame) {
  expect_same_bits_with_every_set(space_about(400.0, 1e-4),
                                  photons_towards_the_middle(scaled(3000)));
}

TEST(SeenPath, RecordsGoByWhatIsMet) {
  const PlannedSpace space = space_about(20.0, 1e-4);
  const auto photons = photons_towards_the_middle(scaled(1000));
  std::vector<Arrival> arrivals(photons.size());
  std::vector<PathRecord> records(photons.size());
  advance_with_records(space, photons, arrivals, records);
  std::size_t known = 0;
  for (std::size_t i = 0; i < photons.size(); ++i) {
    if (!records[i].known() || arrivals[i].fate != Fate::hit) continue;
    ++known;
    const auto points = records[i].points();
    EXPECT_EQ(points.back().length, static_cast<float>(arrivals[i].length)) << i;
    for (std::size_t k = 1; k < points.size(); ++k)
      ASSERT_GE(points[k].length, points[k - 1].length) << i;
  }
  EXPECT_GT(known, photons.size() / 5);
}

}  // namespace
}  // namespace portalens::test
