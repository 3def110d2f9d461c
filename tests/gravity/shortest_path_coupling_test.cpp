#include "gravity/shortest_path_coupling.h"

#include <gtest/gtest.h>

#include "gravity/attraction.h"
#include "gravity/portal_scenes.h"
#include "math/quadrature.h"
#include "support/scale.h"

namespace portalens::test {
namespace {

Vec3d direct(const PortalScene& scene, Vec3d x) {
  Vec3d sum;
  for (const Mass& mass : scene.masses) {
    const Vec3d to = mass.center - x;
    if (length(to) < mass.influence) sum += attraction(to, mass.gm, mass.core * mass.core);
  }
  return sum;
}

/// Σ G M / sqrt(D² + a²) over all images that act.
double potential(const ShortestPathCoupling& coupling, Vec3d x) {
  double sum = 0.0;
  for (const ShortestPathCoupling::Image& image : coupling.images()) {
    const double way = coupling.way(image, x).length;
    if (way < image.influence) sum += image.gm / std::sqrt(way * way + image.core2);
  }
  return sum;
}

TEST(ShortestPathCoupling, IsTheGradientOfTheMassesOverTheirWays) {
  Random random(21);
  int compared = 0;
  for (int round = 0; round < scaled(20); ++round) {
    const PortalScene scene = random_scene(random, 1 + round % 2, 2, 2.0, 0.0);
    const ShortestPathCoupling coupling(scene.input(1 + round % (round % 2 == 0 ? 3 : 2)));
    for (int i = 0; i < 20; ++i) {
      const Vec3d x = random.point(4.0);
      const std::uint64_t here = coupling.signature(x);
      const double h = 2e-4;
      Vec3d gradient;
      bool smooth = true;
      for (double Vec3d::*axis : {&Vec3d::x, &Vec3d::y, &Vec3d::z}) {
        const auto at = [&](double step) {
          Vec3d moved = x;
          moved.*axis += step;
          smooth = smooth && coupling.signature(moved) == here;
          return potential(coupling, moved);
        };
        // Central differences of fourth order.
        gradient.*axis = (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
      }
      const Pull pull = coupling.pull(x, x);
      // Where it bends within a few steps the differences say nothing.
      if (!smooth || pull.nearness > 1e4) continue;
      ASSERT_LE(length(gradient - pull.acceleration), 1e-6 * length(pull.acceleration))
          << round << ' ' << i;
      ++compared;
    }
  }
  EXPECT_GT(compared, scaled(20) * 10);
}

TEST(ShortestPathCoupling, IsContinuousAcrossAFaceWithMassesInFrontOfBoth) {
  Random random(22);
  int compared = 0;
  while (compared < scaled(300)) {
    PortalScene scene;
    scene.min_force = 0.002;
    Frame exit = random_frame(random, 1.0);
    exit.origin += Vec3d{0, 0, 60};
    add_pair(scene, random_polygon(random, 1.0), exit);
    const Portal& a = scene.portals[0];
    const Portal& b = scene.portals[1];
    for (int i = 0; i < 4; ++i) {
      const Vec3d center = (i % 2 == 0 ? a : b).frame.origin + random.point(4.0);
      if (dot(center - a.frame.origin, a.frame.normal) > 0.0 &&
          dot(center - b.frame.origin, b.frame.normal) > 0.0)
        add_mass(scene, center, random.uniform(0.2, 1.0), random.uniform(0.0, 0.2));
    }
    if (scene.masses.empty()) continue;
    const ShortestPathCoupling coupling(scene.input(1 + compared % 3));
    const double s = random.uniform(0.1, 0.4), t = random.uniform(0.1, 0.4);
    const std::vector<Vec3d>& v = a.vertices;
    const Vec3d before = v[0] + (v[1] - v[0]) * s + (v[2] - v[0]) * t;
    const Vec3d after = a.motion()->move(before);
    const Vec3d g_before = direct(scene, before) + coupling.pull(before, before).acceleration;
    const Vec3d g_after = direct(scene, after) + coupling.pull(after, after).acceleration;
    ASSERT_LE(relative_difference(a.motion()->rotate(g_before), g_after), 1e-9) << compared;
    ++compared;
  }
}

/// The corridor of the falling lap, a mass below the floor, and what each chain does on the axis.
class FallingLap : public testing::Test {
 protected:
  static constexpr double w = 0.7, h = 2.3, d = 0.9, gm = 1.7;

  FallingLap() : scene_(corridor(w, h)) { add_mass(scene_, {0, -d, 0}, gm); }

  /// Work of the field falling once from the ceiling to the floor.
  template <class C>
  double work(const C& coupling) const {
    return integrate(
        [&](double y) {
          return -coupling.pull({0, y, 0}, {0, y, 0}).acceleration.y;
        },
        0.0, h, 60);
  }
  double work_of_chain(int depth, const std::vector<std::uint32_t>& chain) const {
    const ShortestPathCoupling coupling(scene_.input(depth));
    for (const auto& image : coupling.images()) {
      if (coupling.chain(image) != chain) continue;
      const auto over = [&](double y) { return image.gm / coupling.way(image, {0, y, 0}).length; };
      return over(0.0) - over(h);
    }
    return 0.0;
  }

  PortalScene scene_;
};

TEST_F(FallingLap, GainsAtTheFirstDepthWhatTheClosedFormSays) {
  const double s = std::hypot(w, d);
  const double direct_work = gm * (1.0 / d - 1.0 / (h + d));
  const double expected =
      gm * (1.0 / d - 1.0 / (2.0 * h + d)) - gm * (1.0 / (w + s) - 1.0 / (std::hypot(w, h) + s));
  const ShortestPathCoupling coupling(scene_.input(1));
  EXPECT_NEAR(direct_work + work(coupling), expected, 1e-9);
}

TEST_F(FallingLap, GainsFromEachChainThroughTheFloorWhatTheClosedFormSays) {
  double sum = gm * (1.0 / d - 1.0 / (h + d));
  for (int n = 1; n <= 6; ++n) {
    const double expected = gm * h / ((n * h + d) * ((n + 1) * h + d));
    const double found = work_of_chain(n, std::vector<std::uint32_t>(n, 0));
    EXPECT_NEAR(found, expected, 1e-9) << n;
    sum += found;
    EXPECT_NEAR(sum, gm * (1.0 / d - 1.0 / ((n + 1) * h + d)), 1e-9) << n;
  }
}

TEST_F(FallingLap, GainsTheDifferenceOfThePotentialsAtAnyDepth) {
  for (int depth = 1; depth <= 4; ++depth) {
    const ShortestPathCoupling coupling(scene_.input(depth));
    const double expected = potential(coupling, {0, 0, 0}) - potential(coupling, {0, h, 0});
    EXPECT_NEAR(work(coupling), expected, 1e-9) << depth;
  }
}

TEST(ShortestPathCoupling, LetsAMassOnThePairActAsIfItStoodInThePortal) {
  Random random(23);
  for (int round = 0; round < scaled(200); ++round) {
    PortalScene scene;
    add_pair(scene, random_polygon(random, 1.0), random_frame(random, 5.0));
    const Portal& a = scene.portals[0];
    add_mass(scene, scene.portals[1].frame.origin, 1.0);
    const ShortestPathCoupling coupling(scene.input(1));
    const Vec3d x = a.frame.to_world({random.uniform(-2, 2), random.uniform(-2, 2), 1.0});
    const Way way = coupling.way(coupling.images()[0], x);
    EXPECT_TRUE(way.straight);
    EXPECT_NEAR(way.length, length(x - a.frame.origin), 1e-12);
  }
}

TEST(ShortestPathCoupling, ChainsNeverGoStraightBackThroughThePair) {
  Random random(24);
  const PortalScene scene = random_scene(random, 2, 1, 3.0, 0.0);
  for (int depth = 0; depth <= 4; ++depth) {
    const ShortestPathCoupling coupling(scene.input(depth));
    double chains = 0.0;
    for (int size = 1; size <= depth; ++size) chains += chain_count(scene.input(depth), size);
    EXPECT_EQ(static_cast<double>(coupling.images().size()), 2.0 * chains);
    for (const auto& image : coupling.images()) {
      const std::vector<std::uint32_t> chain = coupling.chain(image);
      for (std::size_t i = 1; i < chain.size(); ++i)
        EXPECT_NE(chain[i], scene.portals[chain[i - 1]].pair);
    }
  }
}

}  // namespace
}  // namespace portalens::test
