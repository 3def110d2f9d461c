#include "gravity/closest_point_coupling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "gravity/plain_closest_point.h"
#include "gravity/portal_scenes.h"
#include "support/scale.h"

namespace portalens::test {
namespace {

TEST(ClosestPointCoupling, IsTheRecursionOfItsDefinition) {
  Random random(1);
  int acting = 0;
  for (int round = 0; round < scaled(60); ++round) {
    const PortalScene scene = random_scene(random, 1 + round % 3, 3, 3.0, 0.02);
    const Plain plain{scene};
    for (int depth = 0; depth <= 4 - round % 3; ++depth) {
      const ClosestPointCoupling coupling(scene.input(depth));
      for (int i = 0; i < 30; ++i) {
        const Vec3d x = random.point(6.0);
        const Vec3d expected = plain.through(x, depth, scene.portals.size());
        const Vec3d found = coupling.pull(x, x).acceleration;
        ASSERT_LE(relative_difference(found, expected), 1e-12) << round << ' ' << depth;
        acting += length(expected) > 0.0;
      }
    }
  }
  EXPECT_GT(acting, scaled(60) * 30);
}

TEST(ClosestPointCoupling, ReachesAsFarAsItsDefinition) {
  Random random(2);
  for (int round = 0; round < scaled(100); ++round) {
    const PortalScene scene = random_scene(random, 2, 2, 4.0, random.uniform(0.01, 1.0));
    const Plain plain{scene};
    const ClosestPointCoupling coupling(scene.input(3));
    for (std::uint32_t a = 0; a < scene.portals.size(); ++a)
      for (int k = 0; k <= 3; ++k)
        EXPECT_NEAR(coupling.reach(a, k), plain.reach(a, k), 1e-12 * (1.0 + plain.reach(a, k)));
  }
}

TEST(ClosestPointCoupling, BehindASquareTheLowestOfEquallyNearEdgesWins) {
  Random random(3);
  for (int round = 0; round < scaled(1000); ++round) {
    const Frame frame = random_frame(random, 10.0);
    std::vector<Vec3d> square;
    for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
      square.push_back(frame.to_world({double(x), double(y), 0.0}));
    const PortalFace face(portal_on(square));
    EXPECT_EQ(face.nearest({0.0, 0.0, -random.uniform(0.1, 3.0)}),
              (Feature{Feature::Kind::edge, 0}));
    EXPECT_EQ(face.nearest({0.5, 0.5, -1.0}), (Feature{Feature::Kind::edge, 1}));
    EXPECT_EQ(face.nearest({0.5, 0.5, 0.0}).kind, Feature::Kind::face);
    EXPECT_EQ(face.nearest({0.5, 0.5, -1e-9}).kind, Feature::Kind::face);
    EXPECT_EQ(face.nearest({0.5, 0.5, -3e-9}).kind, Feature::Kind::edge);
  }
}

TEST(ClosestPointCoupling, IsContinuousAcrossAFaceWhereTheOtherChainsAreOutOfReach) {
  Random random(4);
  for (int round = 0; round < scaled(300); ++round) {
    PortalScene scene;
    scene.min_force = 0.01;
    add_pair(scene, random_polygon(random, 1.0), random_frame(random, 1.0));
    const Vec3d away{200, 0, 0};
    PortalScene moved;
    moved.min_force = scene.min_force;
    Frame exit = random_frame(random, 1.0);
    exit.origin += away;
    add_pair(moved, scene.portals[0].vertices, exit);
    for (int i = 0; i < 3; ++i) {
      add_mass(moved, random.point(3.0), random.uniform(0.2, 1.0));
      add_mass(moved, random.point(3.0) + away, random.uniform(0.2, 1.0));
    }
    const ClosestPointCoupling coupling(moved.input(1 + round % 3));
    const Plain plain{moved};
    const Portal& a = moved.portals[0];
    const std::vector<Vec3d>& v = a.vertices;
    const double s = random.uniform(0.1, 0.4), t = random.uniform(0.1, 0.4);
    const Vec3d before = v[0] + (v[1] - v[0]) * s + (v[2] - v[0]) * t;
    const Vec3d after = a.motion()->move(before);
    const Vec3d g_before = plain.direct(before) + coupling.pull(before, before).acceleration;
    const Vec3d g_after = plain.direct(after) + coupling.pull(after, after).acceleration;
    EXPECT_LE(relative_difference(a.motion()->rotate(g_before), g_after), 1e-9);
    EXPECT_GT(length(g_before), 0.0);
  }
}

TEST(ClosestPointCoupling, NothingJumpsWithinItsCalm) {
  Random random(5);
  int moved = 0;
  for (int round = 0; round < scaled(300); ++round) {
    const PortalScene scene = random_scene(random, 1 + round % 2, 2, 3.0, 0.02);
    const ClosestPointCoupling coupling(scene.input(1 + round % 3));
    for (int i = 0; i < 20; ++i) {
      const Vec3d x = random.point(5.0);
      const double distance_to_discontinuity = coupling.distance_to_discontinuity(x);
      if (!std::isfinite(distance_to_discontinuity)) continue;
      const Vec3d y = x + random.direction() *
                              (distance_to_discontinuity * random.uniform(0.0, 1.0) * (1.0 - 1e-9));
      const std::vector<PullPart> at_x = coupling.parts(x), at_y = coupling.parts(y);
      ASSERT_EQ(at_x.size(), at_y.size()) << round << ' ' << i;
      for (std::size_t p = 0; p < at_x.size(); ++p) {
        ASSERT_EQ(at_x[p].portals, at_y[p].portals);
        for (std::size_t k = 0; k < at_x[p].places.size(); ++k)
          EXPECT_LE(length(at_x[p].places[k] - at_y[p].places[k]), length(x - y) + 1e-9);
      }
      moved += at_x.size() > 0;
    }
  }
  EXPECT_GT(moved, scaled(300) * 5);
}

TEST(ClosestPointCoupling, IsCalmWhileAnImageRestsOnARim) {
  PortalScene scene;
  scene.min_force = 0.01;
  const std::vector<Vec3d> front = {{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
  // Faces along x; its edges go on where those of the first end.
  const Frame side{{3, 0, 0}, {0, 0, -1}, {0, 1, 0}, {1, 0, 0}};
  add_pair(scene, front, side);
  add_mass(scene, {2, 0, 3}, 90.0);
  const ClosestPointCoupling coupling(scene.input(2));
  Random random(6);
  for (int i = 0; i < scaled(1000); ++i) {
    const Vec3d x{random.uniform(-0.9, 2.9), random.uniform(1.1, 3.0), random.uniform(1.1, 4.0)};
    EXPECT_GT(coupling.distance_to_discontinuity(x), 0.01) << x.x << ' ' << x.y << ' ' << x.z;
  }
}

TEST(ClosestPointCoupling, IsNeitherQuietNorCalmThroughThePlaneOfAFace) {
  PortalScene scene;
  scene.min_force = 0.5;
  const std::vector<Vec3d> face = {{-30, -30, 0}, {30, -30, 0}, {30, 30, 0}, {-30, 30, 0}};
  const Frame exit{{100, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  add_pair(scene, face, exit);
  add_mass(scene, {100, 0, 1}, 8.0);  // felt to a distance of 4, and of 3 before the face
  const ClosestPointCoupling coupling(scene.input(1));
  const Frame& frame = scene.portals[0].frame;
  const auto at = [&](double height, double aside = 2.0) {
    return frame.to_world({aside, 0.0, height});
  };
  // The rim is 28 away, but what comes through the plane has the face before it.
  EXPECT_NEAR(coupling.distance_to_support(at(-5.0)), 2.0, 1e-9);
  EXPECT_NEAR(coupling.distance_to_discontinuity(at(-5.0)), 5.0, 1e-9);
  EXPECT_EQ(coupling.distance_to_support(at(0.5)), 0.0);
  EXPECT_NEAR(coupling.distance_to_support(at(-5.0, 50.0)), std::hypot(20.0, 5.0) - 3.0, 1e-9);
}

}  // namespace
}  // namespace portalens::test
