// Flat faces in one plane: which is met, and which are behind who leaves one.
#include "geometry/flush.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "geometry/accelerator.h"
#include "geometry/samples.h"
#include "math/rigid.h"
#include "support/infinity.h"
#include "support/random.h"
#include "support/scale.h"

namespace portalens::test {
namespace {

/// Moves and turns a whole scene: what is met must not depend on it.
struct Placement {
  Rigid motion;
  double size;

  explicit Placement(std::uint64_t seed) {
    Random random(seed);
    const Vec3d degrees = seed == 0 ? Vec3d{} : random.point(180);
    motion = rotation_about({0, 0, 0}, degrees);
    size = seed == 0 ? 1.0 : std::pow(10.0, random.uniform(-3, 5));
    motion.to =
        seed == 0 ? Vec3d{} : random.direction() * std::pow(10.0, random.uniform(-3, 4)) * size;
  }
  [[nodiscard]] Vec3d operator()(Vec3d p) const { return motion.move(p * size); }
  [[nodiscard]] Ray operator()(const Ray& ray) const {
    return {(*this)(ray.origin), motion.rotate(ray.direction)};
  }
  /// A rectangle on the floor y = 0.
  [[nodiscard]] Quad rug(double x0, double z0, double x1, double z1) const {
    std::vector<Vec3d> v = {{x0, 0, z1}, {x1, 0, z1}, {x1, 0, z0}, {x0, 0, z0}};
    for (Vec3d& corner : v) corner = (*this)(corner);
    return Quad(v);
  }
  [[nodiscard]] Mesh mesh(Triangles triangles) const {
    for (Vec3d& p : triangles.positions) p = (*this)(p);
    return Mesh(std::move(triangles));
  }
};

/// Two triangles over a rectangle on the floor.
Triangles sheet(double x0, double z0, double x1, double z1) {
  Triangles t;
  t.positions = {{x0, 0, z1}, {x1, 0, z1}, {x1, 0, z0}, {x0, 0, z0}};
  for (const auto& [a, b, c] : {std::tuple(0u, 1u, 2u), {0u, 2u, 3u}})
    t.corners.push_back({{{a, 0, 0}, {b, 0, 0}, {c, 0, 0}}});
  return t;
}

constexpr int placements = 30;

/// What is met at (x, 0, z) of the floor, from above and from below, by rays of many directions.
void expect_met(const std::vector<Shape>& shapes, const Placement& place, double x, double z,
                std::uint32_t shape, bool from_above = true, bool from_below = true) {
  const Accelerator accelerator(shapes);
  Random random(7);
  for (int i = 0; i < scaled(40); ++i) {
    Vec3d way = random.direction();
    if (std::fabs(way.y) < 1e-3) continue;
    if (way.y < 0.0 ? !from_above : !from_below) continue;
    const Ray ray = place(Ray{Vec3d{x, 0, z} - way * random.uniform(0.01, 0.2), way});
    const auto hit = accelerator.nearest(ray, 0, infinity);
    ASSERT_TRUE(hit);
    ASSERT_EQ(hit->shape, shape) << "way " << way.x << ' ' << way.y << ' ' << way.z;
  }
}

TEST(FlushFaces, TheSmallerThingIsMetInAnyOrderFromBothSides) {
  for (std::uint64_t seed = 0; seed < placements; ++seed) {
    const Placement place(seed);
    const Quad floor = place.rug(-5, -5, 5, 5), rug = place.rug(-1, -2, 2, 1);
    expect_met({floor, rug}, place, 0.3, 0.4, 1);
    expect_met({rug, floor}, place, 0.3, 0.4, 0);
    expect_met({rug, floor}, place, 3, 3, 1);
    // One that ends in the floor's corner, and three on top of each other.
    expect_met({floor, place.rug(-5, -5, -4, -4)}, place, -4.7, -4.6, 1);
    const std::vector<Shape> stack = {place.rug(-0.5, -0.5, 0.5, 0.5), floor, rug};
    expect_met(stack, place, 0.1, 0.2, 0);
    expect_met(stack, place, 1.5, 0.2, 2);
    expect_met(stack, place, 4, 4, 1);
  }
}

TEST(FlushFaces, OfThingsOfOneSizeTheLaterIsMet) {
  for (std::uint64_t seed = 0; seed < placements; ++seed) {
    const Placement place(seed);
    const std::vector<Shape> shapes = {place.rug(-1, -1, 1, 1), place.rug(-1, -1, 1, 1)};
    expect_met(shapes, place, 0.3, 0.4, 1);
  }
}

TEST(FlushFaces, TriangleSheetsCountByTheirWholeFlatRegion) {
  for (std::uint64_t seed = 0; seed < placements; ++seed) {
    const Placement place(seed);
    const Quad wall = place.rug(-5, -5, 5, 5), picture = place.rug(-1, -1, 1, 1);
    const Mesh decal = place.mesh(sheet(-0.5, -2, 1.5, 2)), floor = place.mesh(sheet(-4, -4, 4, 4));
    expect_met({wall, decal}, place, 0.3, 1.4, 1);
    expect_met({decal, wall}, place, 0.3, 1.4, 0);
    expect_met({floor, wall}, place, 0.3, 1.4, 0);
    expect_met({floor, picture}, place, 0.3, 0.4, 1);
    expect_met({picture, floor}, place, -0.3, 0.4, 0);
    expect_met({floor, decal}, place, 0.3, 1.4, 1);
    expect_met({decal, floor}, place, 0.3, 1.4, 0);
  }
}

TEST(FlushFaces, WithinOneMeshTheLaterTriangleIsMet) {
  for (std::uint64_t seed = 0; seed < placements; ++seed) {
    const Placement place(seed);
    Triangles both = sheet(-4, -4, 4, 4);
    const Triangles decal = sheet(-1, -1, 1, 1);
    for (const auto& corners : decal.corners) {
      both.corners.push_back(corners);
      for (auto& corner : both.corners.back()) corner.position += 4;
    }
    both.positions.insert(both.positions.end(), decal.positions.begin(), decal.positions.end());
    const Accelerator accelerator({place.mesh(both)});
    for (const double side : {1.0, -1.0}) {
      const Vec3d way = normalize(Vec3d{0.3, -side, 0.1});
      const auto face_at = [&](double x, double z) {
        return accelerator.nearest(place(Ray{Vec3d{x, 0, z} - way * 3.0, way}), 0, infinity)->face;
      };
      EXPECT_GE(face_at(0.3, 0.4), 2u);
      EXPECT_GE(face_at(-0.3, -0.4), 2u);
      EXPECT_LT(face_at(2.3, 0.4), 2u);
    }
  }
}

TEST(FlushFaces, WhatStandsOnAFloorIsSeenFromBelowIt) {
  const Placement here(0);
  const Quad floor = here.rug(-5, -5, 5, 5);
  for (const Shape& standing :
       {Shape(Cube({0, 0.5, 0}, {1, 1, 1}, {})), Shape(Cylinder({0, 0, 0}, 1, 0.5, {})),
        Shape(Cone({0, 0, 0}, 1, 0.5, {})), Shape(Ring({0, 0, 0}, 1, 0, 0.5, {}))}) {
    expect_met({floor, standing}, here, 0.2, 0.1, 1, false, true);
    expect_met({standing, floor}, here, 0.2, 0.1, 0, false, true);
    expect_met({standing, floor}, here, 2.2, 0.1, 1);
  }
  // Through the hole of a ring one sees the floor.
  expect_met({Ring({0, 0, 0}, 0.01, 0.4, 0.5, {}), floor}, here, 0.1, 0.1, 1, false, true);
}

TEST(FlushFaces, AWayThatLeavesOneOfThemMeetsNoneOfTheOthers) {
  for (std::uint64_t seed = 0; seed < placements; ++seed) {
    const Placement place(seed);
    const std::vector<Shape> shapes = {place.rug(-5, -5, 5, 5), place.rug(-1, -2, 2, 1),
                                       place.mesh(sheet(-2, -2, 2, 2))};
    const Accelerator accelerator(shapes);
    Random random(seed);
    for (int i = 0; i < scaled(40); ++i) {
      const Vec3d way = random.direction();
      const Ray ray = place(Ray{{random.uniform(-0.9, 0.9), 0, random.uniform(-0.9, 0.9)}, way});
      for (std::uint32_t shape = 0; shape < 3; ++shape) {
        const Vec3d normal = accelerator.surface_at(shape, 0, ray.origin).geometric_normal;
        const double slope = dot(ray.direction, normal);
        const SelfIntersectionGuard guard{shape, 0, slope < 0.0 ? -1.0 : 1.0,
                                          guard_reach(length(ray.origin) + place.size, slope)};
        EXPECT_FALSE(accelerator.nearest(ray, 0, infinity, guard));
      }
    }
  }
}

TEST(FlushFaces, TilesSideBySideHideNothing) {
  std::vector<Shape> tiles;
  const Placement here(0);
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 12; ++j) tiles.emplace_back(here.rug(i, j, i + 1, j + 1));
  const Accelerator accelerator(tiles);
  EXPECT_TRUE(accelerator.flush().overlaps(1).empty());
}

TEST(FlushFaces, AMillionthApartIsNotOnePlane) {
  const Placement here(0);
  Triangles above = sheet(-1, -1, 1, 1);
  for (Vec3d& p : above.positions) p.y = 1e-6;
  const std::vector<Shape> shapes = {here.rug(-5, -5, 5, 5), Mesh(above)};
  const Accelerator accelerator(shapes);
  EXPECT_FALSE(accelerator.flush().any_shapes());
  EXPECT_EQ(accelerator.nearest({{0, 1, 0}, {0, -1, 0}}, 0, infinity)->shape, 1u);
  EXPECT_EQ(accelerator.nearest({{0, -1, 0}, {0, 1, 0}}, 0, infinity)->shape, 0u);
}

}  // namespace
}  // namespace portalens::test
