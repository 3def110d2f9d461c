#include "gravity/graviton_map_coupling.h"

#include <gtest/gtest.h>

#include "gravity/portal_scenes.h"
#include "support/scale.h"

namespace portalens::test {
namespace {

/// Two portals far apart and a mass before the second: smooth over the whole first face.
PortalScene smooth_scene(Random& random) {
  PortalScene scene;
  scene.min_force = 1e-4;
  Frame exit = random_frame(random, 1.0);
  exit.origin += Vec3d{300, 0, 0};
  add_pair(scene, random_polygon(random, 1.0), exit);
  const Portal& b = scene.portals[1];
  add_mass(scene, b.frame.to_world({random.uniform(-1, 1), random.uniform(-1, 1), 1.5}), 1.0);
  return scene;
}

TEST(GravitonMapCoupling, ErrsWithTheSquareOfItsSpacing) {
  Random random(31);
  for (int round = 0; round < scaled(20); ++round) {
    const PortalScene scene = smooth_scene(random);
    double last = 0.0;
    for (int cells : {32, 64, 128}) {
      const GravitonMapCoupling coupling(scene.input(1, cells + 1));
      const double error = coupling.error(0).typical;
      EXPECT_GT(error, 0.0);
      if (last > 0.0) {
        EXPECT_NEAR(std::log2(last / error), 2.0, 0.1) << round;
      }
      last = error;
    }
  }
}

TEST(GravitonMapCoupling, IsClosestPointToWithinItsError) {
  Random random(32);
  for (int round = 0; round < scaled(20); ++round) {
    const PortalScene scene = smooth_scene(random);
    const GravitonMapCoupling coupling(scene.input(2, 65));
    const ClosestPointCoupling exact(scene.input(2));
    for (int i = 0; i < 100; ++i) {
      const Vec3d x = random.point(5.0);
      const Vec3d a = coupling.pull(x, x).acceleration, b = exact.pull(x, x).acceleration;
      EXPECT_LE(relative_difference(a, b), 1e-3);
      EXPECT_EQ(coupling.distance_to_support(x), exact.distance_to_support(x));
    }
  }
}

TEST(GravitonMapCoupling, DecidesAtLinesOnlyWhereTheirKinksCouldBeFelt) {
  Random random(34);
  for (int round = 0; round < scaled(20); ++round) {
    const PortalScene scene = smooth_scene(random);
    CouplingInput input = scene.input(1, 33);
    const GravitonMapCoupling strict(input);
    input.unfelt = 1e-3;
    const GravitonMapCoupling middling(input);
    input.unfelt = 1e6;
    const GravitonMapCoupling lax(input);
    const Frame& frame = scene.portals[0].frame;
    int strict_changes = 0, middling_changes = 0;
    for (int i = 0; i < 200; ++i) {
      // In front of the middle of the face, where nothing changes but the cell.
      const auto place = [&] {
        return frame.to_world({random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), 1.0});
      };
      const Vec3d a = place(), b = place();
      EXPECT_EQ(lax.signature(a), lax.signature(b));
      strict_changes += strict.signature(a) != strict.signature(b);
      middling_changes += middling.signature(a) != middling.signature(b);
      EXPECT_EQ(lax.pull(b, a).acceleration, strict.pull(b, b).acceleration);
    }
    EXPECT_GT(strict_changes, 50);
    EXPECT_LE(middling_changes, strict_changes);
  }
}

TEST(GravitonMapCoupling, PullsNowhereWhileItDecidesThatNothingActs) {
  Random random(36);
  int far_off = 0;
  for (int round = 0; round < scaled(20); ++round) {
    PortalScene scene = smooth_scene(random);
    // An influence that covers a part of the face.
    scene.masses[0].influence = length(scene.masses[0].center - scene.portals[1].frame.origin);
    const GravitonMapCoupling coupling(scene.input(1, 33));
    for (int i = 0; i < 100; ++i) {
      const Vec3d anchor = scene.portals[0].frame.origin + random.point(2.0);
      if (coupling.signature(anchor) != 0) continue;
      // Such a step may run on past the rim, where the point that was nearest is no longer.
      const Vec3d x = anchor + random.point(2.0);
      far_off += coupling.pull(x, x).acceleration != Vec3d{};
      EXPECT_EQ(coupling.pull(x, anchor).acceleration, Vec3d{});
    }
  }
  EXPECT_GT(far_off, 0);
}

TEST(GravitonMapCoupling, HasNoSharpCellWithinItsCalm) {
  // Nodes of a random field that is even but for some.
  Random random(35);
  for (int round = 0; round < scaled(20); ++round) {
    GravitonGrid grid(-1.0, -0.7, 1.0, 0.7, 30);
    grid.fill([&](Vec3d) { return Pull{{0, 0, random.uniform(0, 1) < 0.005 ? 2.0 : 1.0}}; }, 0.1);
    for (int i = 0; i < 300; ++i) {
      const Vec3d from{random.uniform(-1, 1), random.uniform(-0.7, 0.7), 0.0};
      const GravitonGrid::Cell cell = grid.cell_at(from);
      if (grid.to_sharp(cell) == 0) continue;
      const double distance_to_discontinuity =
          grid.distance_to_discontinuity(cell, from) * (1.0 - 1e-9);
      EXPECT_GT(distance_to_discontinuity, 0.0);
      for (int k = 0; k < 20; ++k) {
        const Vec3d way = random.direction() *
                          (std::min(distance_to_discontinuity, 3.0) * random.uniform(0.5, 1.0));
        EXPECT_NE(grid.kind(grid.cell_at(from + way)), GravitonGrid::Kind::sharp);
      }
    }
  }
}

TEST(GravitonMapCoupling, IsExactAtItsNodes) {
  Random random(33);
  for (int round = 0; round < scaled(20); ++round) {
    PortalScene scene;
    scene.min_force = 0.01;
    // A rectangle: its corners and the middles of its edges are nodes if their number is odd.
    const Frame frame = random_frame(random, 2.0);
    Frame exit = random_frame(random, 1.0);
    exit.origin += Vec3d{300, 0, 0};
    add_pair(scene,
             {frame.to_world({-1, -0.6, 0}), frame.to_world({1, -0.6, 0}),
              frame.to_world({1, 0.6, 0}), frame.to_world({-1, 0.6, 0})},
             exit);
    for (int i = 0; i < 3; ++i) add_mass(scene, exit.origin + random.point(4.0), 1.0);
    const GravitonMapCoupling coupling(scene.input(2, 11));
    const ClosestPointCoupling exact(scene.input(2));
    const Vec3d right = frame.right, up = frame.up, out = frame.normal;
    for (const Vec3d& x : {frame.origin + right + up * 0.6, frame.origin - right * 1.7 - up,
                           frame.origin + right * 0.2 + up * 0.2 + out,
                           frame.origin - right * 0.8 - up * 0.4 + out * 0.3})
      EXPECT_LE(
          relative_difference(coupling.pull(x, x).acceleration, exact.pull(x, x).acceleration),
          1e-9);
  }
}

}  // namespace
}  // namespace portalens::test
