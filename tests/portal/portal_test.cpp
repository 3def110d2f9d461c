// The motion through a pair of portals: equations.md, sec. 4.
#include "portal/portal.h"

#include <gtest/gtest.h>

#include "portal/portal_set.h"
#include "support/random.h"
#include "support/scale.h"
#include "support/spaces.h"

namespace portalens::test {
namespace {

/// A polygon congruent to the local outline under a random motion; mirrored for the pair's side.
std::vector<Vec3d> placed(const std::vector<Vec3d>& outline, Random& random, double away) {
  const Vec3d normal = random.direction();
  const Vec3d right = any_perpendicular(normal);
  const Frame frame{random.point(away), right, cross(normal, right), normal};
  std::vector<Vec3d> vertices;
  for (const Vec3d& v : outline) vertices.push_back(frame.to_world(v));
  return vertices;
}

/// The outline that B must have: A's (x, y) at (-x, y), the first edge running from v1 to v0.
std::vector<Vec3d> partner(const std::vector<Vec3d>& outline) {
  std::vector<Vec3d> result;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec3d v = outline[(outline.size() + 1 - i) % outline.size()];
    result.push_back({-v.x, v.y, 0});
  }
  return result;
}

const std::vector<Vec3d> outline = {
    {-1, -1, 0}, {1.2, -1, 0}, {1.6, 0.4, 0}, {0, 1.5, 0}, {-1.3, 0.8, 0}};

TEST(Portal, TwoCrossingsOfAPairRestoreTheRay) {
  Random random(1);
  const int count = scaled(1000000);
  std::vector<Portal> pair;
  for (int i = 0; i < count; ++i) {
    if (i % 100 == 0)
      pair = portal_pair(placed(outline, random, 10.0), placed(partner(outline), random, 10.0));
    const Vec3d x = random.point(10.0), t = random.direction();
    const Vec3d there = pair[0].motion()->move(x), back = pair[1].motion()->move(there);
    const Vec3d turned = pair[1].motion()->rotate(pair[0].motion()->rotate(t));
    ASSERT_LE(length(back - x), 1e-12 * (1.0 + length(x)));
    ASSERT_LE(length(turned - t), 1e-12);
  }
}

TEST(Portal, TheMotionIsProperAndMatchesTheLocalRule) {
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const auto pair =
        portal_pair(placed(outline, random, 10.0), placed(partner(outline), random, 10.0));
    EXPECT_NEAR(pair[0].motion()->determinant(), 1.0, 1e-14);
    EXPECT_LE(congruence_error(pair[0].vertices, pair[1].vertices), 1e-14);
    const Vec3d x = random.point(5.0);
    const Vec3d a = pair[0].frame.to_local(x);
    const Vec3d b = pair[1].frame.to_local(pair[0].motion()->move(x));
    EXPECT_LE(length(b - Vec3d{-a.x, a.y, -a.z}), 1e-13 * (1 + length(a)));
  }
}

TEST(Portal, WritingReadsTheRightWayRoundThroughAPair) {
  // A faces +z at the origin, B faces -z further on: light goes on as if nothing were there.
  const auto pair = portal_pair({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}},
                                {{1, -1, -7}, {-1, -1, -7}, {-1, 1, -7}, {1, 1, -7}});
  EXPECT_LE(congruence_error(pair[0].vertices, pair[1].vertices), 1e-15);
  const Vec3d x = pair[0].motion()->move({0.25, 0.5, 0});
  EXPECT_EQ(x, (Vec3d{0.25, 0.5, -7}));
  EXPECT_EQ(pair[0].motion()->rotate({0.1, 0.2, -0.9}), (Vec3d{0.1, 0.2, -0.9}));
}

TEST(Portal, UnlikePolygonsAreNotCongruent) {
  std::vector<Vec3d> wrong = partner(outline);
  wrong[2].x += 1e-3;
  EXPECT_GT(congruence_error(outline, wrong), 1e-4);
  wrong.pop_back();
  EXPECT_TRUE(std::isinf(congruence_error(outline, wrong)));
}

TEST(PortalSet, ARayMeetsAFrontOnlyAgainstItsNormal) {
  const PortalSet set(portal_pair({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}},
                                  {{1, -1, -7}, {-1, -1, -7}, {-1, 1, -7}, {1, 1, -7}}));
  const auto front = set.nearest({{0.3, 0.2, 2}, {0, 0, -1}}, 0.0, 100.0);
  ASSERT_TRUE(front);
  EXPECT_EQ(front->portal, 0u);
  EXPECT_EQ(front->distance, 2.0);
  EXPECT_FALSE(set.nearest({{0.3, 0.2, -2}, {0, 0, 1}}, 0.0, 100.0));
  EXPECT_FALSE(set.nearest({{0.3, 0.2, 0}, {0, 0, 1}}, 0.0, 100.0));
  EXPECT_FALSE(set.nearest({{1.3, 0.2, 2}, {0, 0, -1}}, 0.0, 100.0));
}

TEST(PortalSet, ABackWithAMaterialIsMetFromBehind) {
  auto pair = portal_pair({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}},
                          {{1, -1, -7}, {-1, -1, -7}, {-1, 1, -7}, {1, 1, -7}});
  pair[0].back_material = 0;
  const PortalSet set(pair);
  const auto back = set.nearest({{0.3, 0.2, -2}, {0, 0, 1}}, 0.0, 100.0);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->side, PortalSide::back);
  EXPECT_EQ(back->distance, 2.0);
}

}  // namespace
}  // namespace portalens::test
