#include "math/triangle_sample.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/random.h"
#include "support/scale.h"

namespace portalens {
namespace {

using test::Random;
using test::scaled;

using std::numbers::pi;

/// Whether the way from the origin goes through the triangle.
bool crosses(const TriangleCorners& t, Vec3d way) {
  const double a = dot(cross(t[0], t[1]), way), b = dot(cross(t[1], t[2]), way),
               c = dot(cross(t[2], t[0]), way);
  const Vec3d normal = cross(t[1] - t[0], t[2] - t[0]);
  return dot(t[0], normal) * dot(way, normal) > 0.0 &&
         ((a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0));
}

TEST(SolidAngle, OfAnOctantIsAnEighthOfAllAndOfFarTrianglesAreaOverSquare) {
  EXPECT_NEAR(solid_angle_of({{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {}), pi / 2, 1e-14);
  EXPECT_NEAR(solid_angle_of({{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}}}, {}), pi / 2, 1e-14);
  EXPECT_NEAR(solid_angle_of({{{9, 0, 0}, {0, 0.1, 0}, {0, 0, 4}}}, {}), pi / 2, 1e-14);
  const TriangleCorners small{{{0, 0, 0}, {1e-6, 0, 0}, {0, 2e-6, 0}}};
  EXPECT_NEAR(solid_angle_of(small, {0, 0, 10}), 1e-14, 1e-20);
  EXPECT_EQ(solid_angle_of(small, {5, 3, 0}), 0.0);
  EXPECT_EQ(solid_angle_of(small, {0, 0, 0}), 0.0);
}

TEST(SampleTriangle, TheMeanOverSamplesIsTheIntegralOverTheSolidAngle) {
  Random random(1);
  for (int round = 0; round < 20; ++round) {
    const TriangleCorners t{{random.point(2), random.point(2), random.point(2)}};
    const double solid_angle = solid_angle_of(t, {});
    const auto weight = [](Vec3d way) { return 1.0 + 0.8 * way.x * way.y; };
    const int count = scaled(20000);
    double seen = 0.0, sampled = 0.0;
    for (int i = 0; i < count; ++i) {
      const Vec3d way = random.direction();
      if (crosses(t, way)) seen += 4 * pi * weight(way) / count;
      const SeenPoint point =
          sample_triangle(t, solid_angle, {}, random.uniform(0, 1), random.uniform(0, 1));
      EXPECT_TRUE(crosses(t, point.position) || solid_angle < 1e-3);
      sampled += point.solid_angle * weight(normalize(point.position)) / count;
    }
    EXPECT_NEAR(sampled, seen, 5 * std::sqrt(4 * pi * seen * 1.8 / count) + 1e-3);
  }
}

/// Small in sight they are drawn by area: no step where one way ends and the other begins.
TEST(SampleTriangle, FarAwayTheMeanIsStillTheSolidAngle) {
  const TriangleCorners t{{{0, 0, 0}, {1, 0.2, 0}, {0.1, 2, 0.3}}};
  for (const double distance : {1e2, 3e3, 6e3, 1.2e4, 1e6, 1e9}) {
    const Vec3d x = normalize(Vec3d{0.3, -0.2, 1}) * distance;
    const double solid_angle = solid_angle_of(t, x);
    Random random(2);
    for (int i = 0; i < 200; ++i) {
      const SeenPoint point =
          sample_triangle(t, solid_angle, x, random.uniform(0, 1), random.uniform(0, 1));
      EXPECT_NEAR(point.solid_angle / solid_angle, 1.0, 8.0 / distance + 1e-7);
      EXPECT_LT(length(point.position), 2.1 + 1e-6 * distance);
    }
  }
}

TEST(SampleTriangle, NoPlaceGivesWhatIsNoNumber) {
  const TriangleCorners t{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  Random random(3);
  for (const double height : {0.0, 1e-300, 1e-17, 1e-12, 1e-6, -1e-9})
    for (const Vec3d at :
         {Vec3d{0.2, 0.2, 0}, {0, 0, 0}, {0.5, 0, 0}, {-3, 4, 0}, {1 + 1e-15, 0, 0}})
      for (int i = 0; i < 20; ++i) {
        const Vec3d x = at + Vec3d{0, 0, height};
        const SeenPoint point =
            sample_triangle(t, solid_angle_of(t, x), x, random.uniform(0, 1), random.uniform(0, 1));
        EXPECT_TRUE(is_finite(point.position) && std::isfinite(point.solid_angle));
        EXPECT_LT(length(point.position), 6.0);
      }
}

TEST(FewWeights, AreChosenAsOftenAsTheyWeigh) {
  FewWeights weights;
  for (const double weight : {0.0, 3.0, 0.0, 0.0, 1.0, 0.0}) weights.add(weight);
  for (int i = 0; i < 400; ++i) {
    const FewWeights::Choice choice = weights.choose(i / 400.0);
    EXPECT_EQ(choice.index, i < 300 ? 1u : 4u);
    EXPECT_DOUBLE_EQ(choice.probability, i < 300 ? 0.75 : 0.25);
    EXPECT_NEAR(choice.left, i < 300 ? i / 300.0 : (i - 300) / 100.0, 1e-12);
  }
}

}  // namespace
}  // namespace portalens
