#include "gravity/closest_point_coupling.h"

#include <gtest/gtest.h>

#include "gravity/portal_scenes.h"
#include "support/scale.h"

namespace portalens::test {
namespace {

/// Physics.md, sec. 5, as plainly as it can be said, sharing nothing with the coupling.
struct Plain {
  const PortalScene& scene;

  static Vec3d on_segment(Vec3d x, Vec3d a, Vec3d b) {
    const double t = dot(x - a, b - a) / dot(b - a, b - a);
    return a + (b - a) * std::clamp(t, 0.0, 1.0);
  }
  static Vec3d on_rim(Vec3d x, const std::vector<Vec3d>& polygon) {
    Vec3d best;
    double least = boundless;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3d y = on_segment(x, polygon[i], polygon[(i + 1) % polygon.size()]);
      if (length(x - y) < least) {
        least = length(x - y);
        best = y;
      }
    }
    return best;
  }
  /// In barycentric coordinates inside, else the nearest point of the outline.
  static Vec3d on_triangle(Vec3d x, Vec3d a, Vec3d b, Vec3d c) {
    const Vec3d n = cross(b - a, c - a);
    const double u = dot(cross(c - b, x - b), n), v = dot(cross(a - c, x - c), n);
    const double w = dot(cross(b - a, x - a), n);
    if (u >= 0.0 && v >= 0.0 && w >= 0.0) return (a * u + b * v + c * w) / (u + v + w);
    return on_rim(x, {a, b, c});
  }
  static Vec3d on_polygon(Vec3d x, const std::vector<Vec3d>& polygon) {
    Vec3d best;
    double least = boundless;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
      const Vec3d y = on_triangle(x, polygon[0], polygon[i], polygon[i + 1]);
      if (length(x - y) < least) {
        least = length(x - y);
        best = y;
      }
    }
    return best;
  }
  static Vec3d closest(Vec3d x, const Portal& portal) {
    const double height = dot(x - portal.vertices[0], portal.frame.normal);
    return height >= -1e-9 * portal.longest_edge ? on_polygon(x, portal.vertices)
                                                 : on_rim(x, portal.vertices);
  }
  double reach(std::size_t a, int k) const {
    if (k == 0) return 0.0;
    const Portal& pair = scene.portals[scene.portals[a].pair];
    double most = 0.0;
    for (const Mass& mass : scene.masses)
      most = std::max(
          most, mass.influence - length(mass.center - on_polygon(mass.center, pair.vertices)));
    for (std::size_t c = 0; c < scene.portals.size(); ++c)
      if (c != scene.portals[a].pair) most = std::max(most, reach(c, k - 1));
    return most;
  }
  Vec3d direct(Vec3d x) const {
    Vec3d sum;
    for (const Mass& mass : scene.masses) {
      const Vec3d d = mass.center - x;
      if (length(d) < mass.influence)
        sum += d * (mass.gm / std::pow(dot(d, d) + mass.core * mass.core, 1.5));
    }
    return sum;
  }
  Vec3d through(Vec3d x, int k, std::size_t left_out) const {
    Vec3d sum;
    if (k == 0) return sum;
    for (std::size_t a = 0; a < scene.portals.size(); ++a) {
      if (a == left_out) continue;
      const Portal& portal = scene.portals[a];
      const Vec3d q = closest(x, portal);
      if (!(length(x - q) < reach(a, k))) continue;
      const Vec3d beyond = portal.through.move(q);
      sum += portal.through.rotate_back(direct(beyond) + through(beyond, k - 1, portal.pair));
    }
    return sum;
  }
};

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
    const Vec3d after = a.through.move(before);
    const Vec3d g_before = plain.direct(before) + coupling.pull(before, before).acceleration;
    const Vec3d g_after = plain.direct(after) + coupling.pull(after, after).acceleration;
    EXPECT_LE(relative_difference(a.through.rotate(g_before), g_after), 1e-9);
    EXPECT_GT(length(g_before), 0.0);
  }
}

}  // namespace
}  // namespace portalens::test
