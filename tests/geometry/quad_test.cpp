// Flat quadrilaterals and triangles: their texture coordinates, their edges, their faults.
#include "geometry/quad.h"

#include <gtest/gtest.h>

#include "geometry/samples.h"
#include "support/infinity.h"
#include "support/scale.h"

namespace portalens::test {
namespace {

TEST(Quad, TextureCoordinatesInvertTheBilinearMap) {
  Random random(1);
  const std::array<std::vector<Vec3d>, 3> outlines = {
      {{{1, 2, 3}, {3, 2, 3}, {3, 2, 1}, {1, 2, 1}},
       {{0, 0, 0}, {4, 0, 0}, {3, 1, 0}, {1, 2, 0}},
       {{0, 0, 0}, {1, 0, 1}, {1.5, 2, 1.5}, {-1, 3, -1}}}};
  for (const auto& v : outlines) {
    const Quad quad(v);
    for (int i = 0; i < scaled(1000); ++i) {
      const double s = random.uniform(0, 1), t = random.uniform(0, 1);
      const Vec3d x =
          v[0] * ((1 - s) * (1 - t)) + v[1] * (s * (1 - t)) + v[2] * (s * t) + v[3] * ((1 - s) * t);
      const SurfacePoint point = quad.surface_at(x, 0);
      EXPECT_NEAR(point.u, s, 1e-11);
      EXPECT_NEAR(point.v, t, 1e-11);
    }
  }
}

TEST(Quad, OwnTextureCoordinatesHoldAtTheVertices) {
  const std::vector<Vec3d> v = {{0, 0, 0}, {4, 0, 0}, {3, 1, 0}, {1, 2, 0}};
  const std::vector<TextureCoordinates> uv = {{2, 3}, {-1, 4}, {0, 0}, {7, 7}};
  for (const std::size_t count : {3u, 4u}) {
    const Quad quad({v.data(), count}, {uv.data(), count});
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_NEAR(quad.surface_at(v[i], 0).u, uv[i][0], 1e-12);
      EXPECT_NEAR(quad.surface_at(v[i], 0).v, uv[i][1], 1e-12);
    }
  }
}

TEST(Quad, LengthsRunAlongTheFirstEdgeAndAcross) {
  const std::vector<Vec3d> v = {{1, 1, 1}, {1, 1, 4}, {1, 3, 4}, {1, 3, 1}};
  const SurfacePoint point = Quad(v).surface_at({1, 1.5, 3}, 0);
  EXPECT_TRUE(point.flat);
  EXPECT_NEAR(point.along, 2, 1e-15);
  EXPECT_NEAR(point.across, 0.5, 1e-15);
}

TEST(Quad, ItsFrontIsWhereTheVerticesRunCounterClockwise) {
  EXPECT_EQ(Quad(std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}).normal(),
            (Vec3d{0, 0, 1}));
}

TEST(Quad, NeighboursLeaveNoGap) {
  // A fan about one point, turned so that nothing is exact; lines at spokes and centre.
  for (const double away : {0.0, 1e5}) {
    const Rigid turn = rotation_about({away, 0, away}, {31, 47, 71});
    std::vector<Quad> fan;
    std::vector<Vec3d> rim;
    const int count = 7;
    for (int i = 0; i < count; ++i)
      rim.push_back(Vec3d{away, 0, away} +
                    Vec3d{std::cos(i * 2 * M_PI / count), 0, std::sin(i * 2 * M_PI / count)} * 2);
    for (Vec3d& p : rim) p = turn.move(p);
    for (int i = 0; i < count; ++i)
      fan.emplace_back(std::vector<Vec3d>{turn.to, rim[i], rim[(i + 1) % count]});
    Random random(2);
    for (int i = 0; i < scaled(20000); ++i) {
      const Vec3d spoke = rim[i % count];
      const Vec3d target = turn.to + (spoke - turn.to) * (i % 3 ? random.uniform(0, 0.99) : 0.0);
      const Vec3d way = random.direction();
      const Ray ray{target - way * random.uniform(0.1, 5), way};
      int hits = 0;
      for (const Quad& quad : fan) hits += quad.intersect(ray, 0, infinity).has_value();
      EXPECT_GE(hits, 1);
    }
  }
}

TEST(Quad, LinesInItsPlaneMeetNothing) {
  const Quad quad(std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  EXPECT_FALSE(quad.intersect({{-1, 0.5, 0}, {1, 0, 0}}, 0, infinity).has_value());
  EXPECT_FALSE(quad.intersect({{5, 0.5, 0}, {0, 1, 0}}, 0, infinity).has_value());
}

}  // namespace
}  // namespace portalens::test
