// Polygons that are cut into triangles keep their area, their side and their holes.
#include "math/triangulate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/random.h"
#include "support/scale.h"

namespace portalens::test {
namespace {

using std::numbers::pi;

Vec3d area_of(const std::vector<Vec3d>& p, const std::array<std::size_t, 3>& t) {
  return cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]) * 0.5;
}

/// A simple polygon around the origin whose corners lie at ever larger angles.
std::vector<Vec3d> star(Random& random, std::size_t count) {
  std::vector<Vec3d> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * pi * static_cast<double>(i) / static_cast<double>(count);
    const double r = random.uniform(0.2, 1.0);
    points.push_back({r * std::cos(angle), r * std::sin(angle), 0.3 * r * std::cos(angle)});
  }
  return points;
}

TEST(Polygon, TrianglesHaveThePolygonsAreaAndItsSide) {
  Random random(1);
  for (int trial = 0; trial < scaled(200); ++trial) {
    const std::vector<Vec3d> points = star(random, 4 + static_cast<std::size_t>(trial) % 40);
    const auto triangles = triangulate(points);
    ASSERT_EQ(triangles.size(), points.size() - 2);
    Vec3d whole;
    for (std::size_t i = 0; i < points.size(); ++i) {
      whole += cross(points[i], points[(i + 1) % points.size()]) * 0.5;
    }
    Vec3d sum;
    for (const auto& triangle : triangles) {
      const Vec3d area = area_of(points, triangle);
      EXPECT_GE(dot(area, whole), 0.0);  // so that none overlap
      sum += area;
    }
    EXPECT_NEAR(length(sum - whole), 0.0, 1e-12);
  }
}

/// Whether a place in the plane z = 0 lies in some of the triangles.
bool covered(const std::vector<Vec3d>& p, const std::vector<std::array<std::size_t, 3>>& triangles,
             double x, double y) {
  return std::any_of(triangles.begin(), triangles.end(), [&](const auto& t) {
    const auto side = [&](std::size_t a, std::size_t b) {
      return (p[b].x - p[a].x) * (y - p[a].y) - (p[b].y - p[a].y) * (x - p[a].x);
    };
    return side(t[0], t[1]) > 0 && side(t[1], t[2]) > 0 && side(t[2], t[0]) > 0;
  });
}

TEST(Polygon, AnOutlineThatGoesRoundHolesLeavesThemOpen) {
  Random random(4);
  for (int trial = 0; trial < scaled(200); ++trial) {
    // A ring of two stars, and a wall with windows in a row, each cut open by a bridge.
    const std::size_t count = 3 + static_cast<std::size_t>(trial) % 30;
    std::vector<Vec3d> points;
    const auto at = [&](std::size_t i, double r) {
      const double angle = 2 * pi * static_cast<double>(i % count) / static_cast<double>(count);
      return Vec3d{r * std::cos(angle), r * std::sin(angle), 0};
    };
    std::vector<double> inner(count), outer(count);
    for (std::size_t i = 0; i < count; ++i) {
      inner[i] = random.uniform(0.2, 0.4);
      outer[i] = random.uniform(1.0, 2.0);
    }
    for (std::size_t i = 0; i <= count; ++i) points.push_back(at(i, outer[i % count]));
    for (std::size_t i = 0; i <= count; ++i)
      points.push_back(at(count - i, inner[(count - i) % count]));
    double expected = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const auto wedge = [&](const std::vector<double>& r) {
        return 0.5 * length(cross(at(i, r[i]), at(i + 1, r[(i + 1) % count])));
      };
      expected += wedge(outer) - wedge(inner);
    }
    const auto triangles = triangulate(points);
    double area = 0.0;
    for (const auto& triangle : triangles) {
      EXPECT_GE(area_of(points, triangle).z, -1e-12);
      area += length(area_of(points, triangle));
    }
    EXPECT_NEAR(area, expected, 1e-9) << count;
    EXPECT_FALSE(covered(points, triangles, 0.01, 0.02)) << count;
  }
}

TEST(Polygon, AWallWithARowOfWindowsKeepsThem) {
  for (const int windows : {1, 2, 5}) {
    // Along the lower edge, up to each window's corner, round it, and down again.
    std::vector<Vec3d> points{{0, 0, 0}};
    for (int i = 0; i < windows; ++i) {
      const double x = 1 + 3 * i;
      for (const Vec3d& p : {Vec3d{x, 0, 0},
                             {x, 1, 0},
                             {x, 2, 0},
                             {x + 1, 2, 0},
                             {x + 1, 1, 0},
                             {x, 1, 0},
                             {x, 0, 0}})
        points.push_back(p);
    }
    points.insert(points.end(), {{3.0 * windows, 0, 0}, {3.0 * windows, 3, 0}, {0, 3, 0}});
    const auto triangles = triangulate(points);
    double area = 0.0;
    for (const auto& triangle : triangles) area += length(area_of(points, triangle));
    EXPECT_NEAR(area, 9.0 * windows - windows, 1e-12);
    for (int i = 0; i < windows; ++i)
      EXPECT_FALSE(covered(points, triangles, 1.49 + 3 * i, 1.52)) << i;
  }
}

TEST(Polygon, AQuadIsCutInsideAndAlongItsShorterDiagonal) {
  const std::vector<Vec3d> kite{{0, 0, 0}, {1, -0.2, 0}, {2, 0, 0}, {1, 0.2, 0}};
  const auto triangles = triangulate(kite);
  EXPECT_EQ(triangles[0], (std::array<std::size_t, 3>{0, 1, 3}));
  const std::vector<Vec3d> dart{{0, 0, 0}, {2, -1, 0}, {0.5, 0, 0}, {2, 1, 0}};
  for (const auto& triangle : triangulate(dart)) EXPECT_GT(area_of(dart, triangle).z, 0.0);
}

TEST(Polygon, OneThatCrossesItselfOrHasNoAreaStillEnds) {
  Random random(2);
  for (std::size_t count = 4; count < 200; count += 7) {
    std::vector<Vec3d> points(count);
    EXPECT_EQ(triangulate(points).size(), count - 2);
    for (Vec3d& p : points) p = random.point(1.0);
    EXPECT_EQ(triangulate(points).size(), count - 2);
  }
}

}  // namespace
}  // namespace portalens::test
