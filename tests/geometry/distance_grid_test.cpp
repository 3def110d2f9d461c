// How far from a mesh a place is, by its grid, held against the triangles themselves.
#include "geometry/distance_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "geometry/closest_point.h"
#include "geometry/samples.h"
#include "support/scale.h"

namespace portalens::test {
namespace {

double distance_to(const Mesh& mesh, Vec3d x) {
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t face = 0; face < mesh.triangle_count(); ++face) {
    const auto [a, b, c] = mesh.triangle(face);
    least = std::min(least, length(x - closest_on_triangle(a, b, c, x)));
  }
  return least;
}

/// Long triangles through all of a box, in all directions.
Triangles straw(int count, Vec3d center, Random& random) {
  Triangles straw;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(count); ++i) {
    const Vec3d from = center + random.point(1.0), to = center + random.point(1.0);
    straw.positions.insert(straw.positions.end(), {from, to, to + random.point(0.01)});
    straw.corners.push_back({{{3 * i, 0, 0}, {3 * i + 1, 0, 0}, {3 * i + 2, 0, 0}}});
  }
  return straw;
}

std::vector<Mesh> meshes_about(Vec3d at) {
  Random random(20);
  Triangles one;
  one.positions = {at, at + Vec3d{1, 0, 0}, at + Vec3d{0, 1, 0}};
  one.corners.push_back({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}});
  return {Mesh(crate(at - Vec3d{1, 0.5, 1}, at + Vec3d{1, 1, 0.7})),
          Mesh(crate(at, at + Vec3d{3.0, 0.001, 0.2})), Mesh(globe(20, at, 1.2, true)),
          Mesh(straw(60, at, random)), Mesh(one)};
}

TEST(DistanceGrid, NeverTellsMoreThanTheDistanceAndNotMuchLess) {
  for (const double away : {0.0, 1e5}) {
    const Vec3d at{away, -away, 0.5 * away};
    for (const Mesh& mesh : meshes_about(at)) {
      const DistanceGrid grid(mesh);
      Random random(21);
      for (int i = 0; i < scaled(1000); ++i) {
        const Vec3d x = at + random.point(i % 3 == 0 ? 5.0 : 1.2);
        const double truth = distance_to(mesh, x), found = grid.clearance(x);
        EXPECT_LE(found, truth);
        EXPECT_GE(found, 0.75 * truth - 3.0 * grid.cell());
      }
    }
  }
}

TEST(DistanceGrid, ARayIsFreeAsFarAsItSays) {
  int passed = 0, rays = 0;
  for (const Mesh& mesh : meshes_about({3, 2, 1})) {
    const DistanceGrid grid(mesh);
    Random random(24);
    for (int i = 0; i < scaled(500); ++i) {
      const Ray ray = ray_towards(mesh, random);
      const double low = random.uniform(0.0, 2.0), high = low + random.uniform(0.0, 4.0);
      const double radius = i % 2 ? random.uniform(0.0, 0.3) : 0.0;
      const double until = grid.free_until(ray, low, high, radius);
      EXPECT_GE(until, low);
      for (int k = 0; k < 10; ++k) {
        const double at = std::min(until, high) * random.uniform(0.0, 1.0);
        if (at >= low) {
          EXPECT_GE(distance_to(mesh, ray.at(at)), radius);
        }
      }
      if (const auto met = mesh.intersect(ray, low, high)) {
        EXPECT_LE(until, met->distance);
      }
      passed += until > low ? 1 : 0;
      ++rays;
    }
  }
  EXPECT_GT(passed, rays / 4);
}

TEST(DistanceGrid, TellsNothingOnTheMesh) {
  for (const Mesh& mesh : meshes_about({3, 2, 1})) {
    const DistanceGrid grid(mesh);
    Random random(22);
    for (int i = 0; i < scaled(1000); ++i)
      EXPECT_EQ(grid.clearance(mesh.sample(random.uniform(0, 1), random.uniform(0, 1)).position),
                0.0);
  }
}

TEST(DistanceGrid, TinyMeshesFarAwayAreStillBounded) {
  for (const double away : {0.0, 1e3, 1e11}) {
    Triangles tiny;
    tiny.positions = {{away, 0, 0}, {away, 1e-60, 0}, {away, 0, 1e-60}};
    tiny.corners.push_back({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}});
    const Mesh mesh{tiny};
    ASSERT_EQ(mesh.triangle_count(), 1u);
    const DistanceGrid grid(mesh);
    EXPECT_EQ(grid.clearance({away, 0, 0}), 0.0);
    EXPECT_LE(grid.clearance({away, 3, 4}), 5.0);
    EXPECT_GE(grid.clearance({away, 3, 4}), 4.0);
  }
}

TEST(DistanceGrid, ManyTrianglesThroughAllOfTheBoxStillBoundIt) {
  Random random(23);
  const Mesh mesh(straw(30000, {}, random));
  const DistanceGrid grid(mesh);
  for (int i = 0; i < scaled(50); ++i) {
    const Vec3d x = random.point(1.5);
    EXPECT_LE(grid.clearance(x), distance_to(mesh, x));
  }
}

}  // namespace
}  // namespace portalens::test
