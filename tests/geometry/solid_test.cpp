// What is particular to each solid: where it stands, what it weighs, how pictures lie on it.
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/samples.h"
#include "support/infinity.h"
#include "support/scale.h"

namespace portalens::test {
namespace {

void expect_close(Vec3d a, Vec3d b, double tolerance = 1e-12) {
  EXPECT_LT(length(a - b), tolerance)
      << a.x << ' ' << a.y << ' ' << a.z << " and " << b.x << ' ' << b.y << ' ' << b.z;
}

/// The volume centroid, from lines along x through a solid.
template <class Type>
Vec3d centroid(const Type& solid) {
  const Box box = solid.bounds();
  Random random(1);
  Vec3d sum;
  double volume = 0;
  for (int i = 0; i < scaled(100000); ++i) {
    const Vec3d from{box.low.x - 1, random.uniform(box.low.y, box.high.y),
                     random.uniform(box.low.z, box.high.z)};
    const auto in = solid.intersect({from, {1, 0, 0}}, 0, infinity);
    if (!in) continue;
    double low = in->distance, side = 1;
    while (const auto out = solid.intersect({from, {1, 0, 0}}, low + 1e-9, infinity)) {
      if (side > 0) {
        const double piece = out->distance - low;
        volume += piece;
        sum += Vec3d{from.x + 0.5 * (low + out->distance), from.y, from.z} * piece;
      }
      side = -side, low = out->distance;
    }
  }
  return sum / volume;
}

TEST(Solids, CentresOfMassAreCentroidsOfTheVolume) {
  const auto check = [](const auto& solid) {
    expect_close(solid.center_of_mass(), centroid(solid), 6 / std::sqrt(scaled(100000)));
  };
  for (const auto& s : Samples<Sphere>::about({1, 2, 3})) check(s);
  for (const auto& s : Samples<Cube>::about({1, 2, 3})) check(s);
  for (const auto& s : Samples<Cone>::about({1, 2, 3})) check(s);
  for (const auto& s : Samples<Cylinder>::about({1, 2, 3})) check(s);
  for (const auto& s : Samples<Ring>::about({1, 2, 3})) check(s);
  for (const auto& s : Samples<Mesh>::about({1, 2, 3})) check(s);
}

TEST(Solids, BoxesAreTight) {
  for_each_sample({1, 2, 3}, [](const auto& shape) {
    Box seen;
    Random random(2);
    for (int i = 0; i < 40000; ++i)
      seen.add(shape.sample(random.uniform(0, 1), random.uniform(0, 1)).position);
    const Box box = shape.bounds();
    const double tolerance = 0.04 * box.diagonal();
    expect_close(box.low, seen.low, tolerance);
    expect_close(box.high, seen.high, tolerance);
    EXPECT_EQ(box.grown(1e-12).distance(seen.low), 0.0);
    EXPECT_EQ(box.grown(1e-12).distance(seen.high), 0.0);
  });
}

/// Turning the solid and the ray together about the middle of its box changes no distance.
TEST(Solids, TurnAboutTheMiddleOfTheirBox) {
  const Vec3d degrees{25, -40, 110}, base{0.5, -1, 2};
  const auto check = [&](const auto& straight, const auto& turned, Vec3d middle) {
    const Rigid turn = rotation_about(middle, degrees);
    Random random(3);
    for (int i = 0; i < scaled(500); ++i) {
      const Ray ray = ray_towards(straight, random);
      const Ray other{turn.move(ray.origin), turn.rotate(ray.direction)};
      const auto a = straight.intersect(ray, 0, infinity);
      const auto b = turned.intersect(other, 0, infinity);
      ASSERT_EQ(a.has_value(), b.has_value());
      if (!a) continue;
      EXPECT_NEAR(a->distance, b->distance, 1e-10);
      if (a->face != b->face) continue;  // at an edge
      const auto p = straight.surface_at(ray.at(a->distance), a->face);
      const auto q = turned.surface_at(other.at(b->distance), b->face);
      expect_close(turn.rotate(p.normal), q.normal, 1e-9);
      EXPECT_NEAR(std::remainder(p.u - q.u, 1.0), 0, 1e-8);
      EXPECT_NEAR(p.v, q.v, 1e-8);
    }
  };
  const auto above = [&](double height) { return base + Vec3d{0, 0.5 * height, 0}; };
  check(Cube(base, {1, 2, 3}, {}), Cube(base, {1, 2, 3}, degrees), base);
  check(Cone(base, 2, 1, {}), Cone(base, 2, 1, degrees), above(2));
  check(Cylinder(base, 3, 1, {}), Cylinder(base, 3, 1, degrees), above(3));
  check(Ring(base, 1, 0.5, 1, {}), Ring(base, 1, 0.5, 1, degrees), above(1));
}

TEST(Solids, ASphereMeetsTheClosedFormOfItsTexture) {
  const Sphere sphere({1, 2, 3}, 2);
  const auto at = [&](Vec3d way) { return sphere.surface_at(Vec3d{1, 2, 3} + way * 2, 0); };
  EXPECT_NEAR(at({0, 0, 1}).u, 0.5, 1e-15);
  EXPECT_NEAR(at({1, 0, 0}).u, 0.75, 1e-15);
  EXPECT_NEAR(at({-1, 0, 0}).u, 0.25, 1e-15);
  EXPECT_NEAR(at({0, 1, 0}).v, 1.0, 1e-15);
  EXPECT_NEAR(at({0, -1, 0}).v, 0.0, 1e-15);
  EXPECT_NEAR(at({0, 0.5, std::sqrt(0.75)}).v, 0.5 + std::asin(0.5) / M_PI, 1e-15);
}

TEST(Solids, PicturesReadTheRightWayRoundFromOutside) {
  // Seen against the normal, u grows to the right of v: (du × dv) · normal > 0.
  const auto check = [](const auto& shape) {
    Random random(4);
    for (int i = 0; i < scaled(300); ++i) {
      const auto point = shape.sample(random.uniform(0, 1), random.uniform(0, 1));
      const auto hit = shape.intersect({point.position + point.normal * 1e-3, -point.normal}, 0, 1);
      ASSERT_TRUE(hit.has_value());
      const Vec3d right = any_perpendicular(point.normal), up = cross(point.normal, right);
      const auto a = shape.surface_at(point.position, hit->face);
      const auto b = shape.surface_at(point.position + right * 1e-6, hit->face);
      const auto c = shape.surface_at(point.position + up * 1e-6, hit->face);
      if (std::fabs(b.u - a.u) > 0.5 || std::fabs(c.u - a.u) > 0.5) continue;  // the seam
      EXPECT_GE((b.u - a.u) * (c.v - a.v) - (c.u - a.u) * (b.v - a.v), -1e-18);
    }
  };
  check(Sphere({}, 1));
  check(Cube({}, {1, 2, 3}, {10, 20, 30}));
  check(Cylinder({}, 1, 2, {10, 20, 30}));
  check(Cone({}, 1, 2, {10, 20, 30}));
  for (const auto& quad : Samples<Quad>::about({})) check(quad);
}

TEST(Solids, LengthsAlongACubesFacesAreLengths) {
  const Cube cube({}, {2, 3, 5}, {10, 20, 30});
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    const auto a = cube.sample(random.uniform(0, 0.02), random.uniform(0, 1));
    const auto b = cube.sample(random.uniform(0, 0.02), random.uniform(0, 1));
    EXPECT_TRUE(a.flat);
    EXPECT_NEAR(std::hypot(a.along - b.along, a.across - b.across), length(a.position - b.position),
                1e-12);
  }
}

TEST(Solids, ARingHasAHole) {
  const Ring ring({}, 1, 1, 2, {});
  EXPECT_FALSE(ring.intersect({{0, 5, 0}, {0, -1, 0}}, 0, infinity).has_value());
  EXPECT_NEAR(ring.intersect({{0, 0.5, 0}, {1, 0, 0}}, 0, infinity)->distance, 1.0, 1e-14);
  EXPECT_EQ(ring.surface_at({1, 0.5, 0}, 1).normal, (Vec3d{-1, 0, 0}));
  EXPECT_NEAR(ring.clearance({{0, 0.2, 0}, {0, 0.8, 0}}), 1.0, 1e-14);
}

TEST(Solids, LinesThroughTheTipOfAConeMeetIt) {
  const Cone cone({1, 2, 3}, 2, 1, {20, 30, 40});
  const Vec3d base = cone.center_of_mass();
  Random random(6);
  for (int i = 0; i < scaled(2000); ++i) {
    // From within, whatever path: never out without a contact.
    const Ray ray{base + random.point(0.1), random.direction()};
    EXPECT_TRUE(cone.intersect(ray, 0, infinity).has_value());
  }
}

}  // namespace
}  // namespace portalens::test
