// Laws that every shape of the list keeps.
#include "geometry/shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/closest_point.h"
#include "geometry/samples.h"
#include "support/infinity.h"
#include "support/list_types.h"
#include "support/scale.h"

namespace portalens::test {
namespace {

template <class Type>
class EachShape : public testing::Test {};

TYPED_TEST_SUITE(EachShape, TypesOf<Shape>::type);

/// How far a point is from the surface, from the shape's own account of what lies near.
template <class Type>
double off_surface(const Type& shape, Vec3d x) {
  return shape.clearance({x, x});
}

TYPED_TEST(EachShape, ContactsLieOnTheSurfaceAndInTheBox) {
  for (const double away : {0.0, 1e5}) {
    for (const TypeParam& shape : Samples<TypeParam>::about({away, -away, away})) {
      Random random(1);
      int hits = 0;
      for (int i = 0; i < scaled(2000); ++i) {
        const Ray ray = ray_towards(shape, random);
        const auto contact = shape.intersect(ray, 0.0, infinity);
        if (!contact) continue;
        ++hits;
        const Vec3d x = ray.at(contact->distance);
        const double tolerance = 1e-11 + 1e-15 * away * 20;
        EXPECT_LT(off_surface(shape, x), tolerance);
        EXPECT_LT(shape.bounds().distance(x), tolerance);
        const SurfacePoint point = shape.surface_at(x, contact->face);
        EXPECT_LT(length(point.position - x), 10 * tolerance);
        EXPECT_NEAR(length(point.normal), 1.0, 1e-12);
        EXPECT_NEAR(length(point.geometric_normal), 1.0, 1e-12);
      }
      EXPECT_GT(hits, scaled(2000) / 3);
    }
  }
}

TYPED_TEST(EachShape, NothingIsPassedBeforeTheNearestContact) {
  for (const TypeParam& shape : Samples<TypeParam>::about({})) {
    Random random(2);
    for (int i = 0; i < scaled(300); ++i) {
      const Ray ray = ray_towards(shape, random);
      const auto contact = shape.intersect(ray, 0.0, 8.0);
      const double end = contact ? contact->distance : 8.0;
      // Sphere tracing by the shape's own distance gets as far as the contact, and no farther.
      double s = 0.0;
      for (int step = 0; step < 4000 && s < end; ++step) {
        const double room = off_surface(shape, ray.at(s));
        if (room < 1e-9) break;
        s += room;
      }
      if (contact) {
        EXPECT_LE(s, end + 1e-6);
      } else {
        EXPECT_GE(s, end - 1e-6) << "a surface was passed without a contact";
      }
    }
  }
}

TYPED_TEST(EachShape, RangesSelectContactsWithoutChangingThem) {
  for (const TypeParam& shape : Samples<TypeParam>::about({0.1, 0.2, 0.3})) {
    Random random(3);
    for (int i = 0; i < scaled(500); ++i) {
      const Ray ray = ray_towards(shape, random);
      std::vector<double> found;
      double low = -10.0;
      while (const auto contact = shape.intersect(ray, low, infinity)) {
        found.push_back(contact->distance);
        low = std::nextafter(contact->distance, infinity);
        ASSERT_LT(found.size(), 50u);
      }
      EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
      for (const double distance : found) {
        const auto again = shape.intersect(ray, distance, distance);
        ASSERT_TRUE(again.has_value());
        EXPECT_EQ(again->distance, distance);
      }
    }
  }
}

TYPED_TEST(EachShape, SamplesLieOnTheSurfaceWithCoordinatesInTheirRange) {
  for (const TypeParam& shape : Samples<TypeParam>::about({3, 1, -2})) {
    Random random(4);
    for (int i = 0; i < scaled(2000); ++i) {
      const SurfacePoint point = shape.sample(random.uniform(0, 1), random.uniform(0, 1));
      EXPECT_LT(off_surface(shape, point.position), 1e-13);
      EXPECT_GE(point.u, -1e-12);
      EXPECT_LE(point.u, 1.0 + 1e-12);
      EXPECT_GE(point.v, -1e-12);
      EXPECT_LE(point.v, 1.0 + 1e-12);
      EXPECT_NEAR(length(point.geometric_normal), 1.0, 1e-12);
      EXPECT_GT(dot(point.normal, point.geometric_normal), 0.0);
    }
  }
}

/// Mean over directions and parallel lines: the number of times that lines of unit density cross a
/// surface is half its area, whatever its shape (Cauchy, Crofton). Weighted by where they cross, it
/// measures where the area is; so it holds `sample` and `area` against `intersect`.
TYPED_TEST(EachShape, LinesCrossItAsOftenAsItsAreaAndSamplesSay) {
  for (const TypeParam& shape : Samples<TypeParam>::about({0.4, 0.1, 0.2})) {
    const Vec3d middle = shape.bounds().middle();
    const double radius = 0.5 * shape.bounds().diagonal() * 1.01;
    Random random(5);
    const int lines = scaled(20000);
    double crossings = 0.0;
    Vec3d sum, sum_of_squares;
    for (int i = 0; i < lines; ++i) {
      const Vec3d way = random.direction(), right = any_perpendicular(way), up = cross(way, right);
      const double r = radius * std::sqrt(random.uniform(0, 1)), turn = random.uniform(0, 2 * M_PI);
      const Vec3d from =
          middle + right * (r * std::cos(turn)) + up * (r * std::sin(turn)) - way * (2 * radius);
      double low = 0.0;
      while (const auto contact = shape.intersect({from, way}, low, infinity)) {
        const Vec3d x = from + way * contact->distance - middle;
        crossings += 1.0, sum += x, sum_of_squares += x * x;
        low = contact->distance + 1e-9;
      }
    }
    const double disc = M_PI * radius * radius;
    const double area = 2.0 * disc * crossings / lines;
    EXPECT_NEAR(area / shape.area(), 1.0, 6.0 * std::sqrt(disc * 4 / (shape.area() * lines)));
    Vec3d mean, mean_of_squares;
    const int points = scaled(20000);
    for (int i = 0; i < points; ++i) {
      const Vec3d x = shape.sample(random.uniform(0, 1), random.uniform(0, 1)).position - middle;
      mean += x / points, mean_of_squares += x * x / points;
    }
    const double tolerance = 6.0 / std::sqrt(std::min<double>(points, crossings) / 4.0);
    EXPECT_LT(length(mean - sum / crossings), tolerance * radius);
    EXPECT_LT(length(mean_of_squares - sum_of_squares / crossings), tolerance * radius * radius);
  }
}

/// The directions in which it is seen, told by rays; weighted, so that it counts where they are.
TYPED_TEST(EachShape, WhatIsSeenOfItIsSampledByItsSolidAngle) {
  const auto weight = [](Vec3d way) { return 1.0 + 0.5 * way.x + 0.3 * way.y * way.z; };
  for (const TypeParam& shape : Samples<TypeParam>::about({0.4, 0.1, 0.2})) {
    if constexpr (requires { shape.sample_seen(Vec3d{}, 0.5, 0.5); }) {
      Random random(10);
      for (int place = 0; place < 6; ++place) {
        const Vec3d x = shape.bounds().middle() + random.point(place < 3 ? 1.5 : 6);
        const int count = scaled(20000);
        double seen = 0.0, sampled = 0.0, squares = 0.0;
        for (int i = 0; i < count; ++i) {
          const Vec3d way = random.direction();
          if (shape.intersect({x, way}, 0.0, infinity)) seen += 4 * M_PI * weight(way) / count;
          const auto [point, solid_angle] =
              shape.sample_seen(x, random.uniform(0, 1), random.uniform(0, 1));
          EXPECT_LT(off_surface(shape, point.position), 1e-12);
          if (solid_angle == 0.0) continue;
          const double distance = length(point.position - x);
          const Vec3d towards = (point.position - x) / distance;
          const auto first = shape.intersect({x, towards}, 0.0, infinity);
          EXPECT_TRUE(!first || first->distance > distance - 1e-6) << "it hides itself";
          const double value = solid_angle * weight(towards);
          sampled += value / count, squares += value * value / count;
        }
        const double error = std::sqrt((squares + 8 * M_PI * (seen + 8 * M_PI / count)) / count);
        EXPECT_NEAR(sampled, seen, 5 * error);
      }
    }
  }
}

TYPED_TEST(EachShape, ClearanceNeverExceedsTheDistanceToAnyPointOfIt) {
  for (const TypeParam& shape : Samples<TypeParam>::about({-1, 0, 1})) {
    Random random(6);
    std::vector<Vec3d> points;
    for (int i = 0; i < 400; ++i)
      points.push_back(shape.sample(random.uniform(0, 1), random.uniform(0, 1)).position);
    for (int i = 0; i < scaled(300); ++i) {
      const Vec3d a = Vec3d{-1, 0, 1} + random.point(3);
      const Segment segment{
          a, a + random.direction() * (3 * random.uniform(0, 1) * random.uniform(0, 1))};
      const double bound = shape.clearance(segment);
      EXPECT_GE(bound, 0.0);
      for (const Vec3d& point : points) {
        const double distance = length(point - closest_on_segment(segment.a, segment.b, point));
        ASSERT_LE(bound, distance + 1e-12);
      }
    }
  }
}

TYPED_TEST(EachShape, ClearanceOfAPointIsItsDistance) {
  for (const TypeParam& shape : Samples<TypeParam>::about({-1, 0, 1})) {
    Random random(7);
    std::vector<Vec3d> points;
    for (int i = 0; i < 20000; ++i)
      points.push_back(shape.sample(random.uniform(0, 1), random.uniform(0, 1)).position);
    const double spacing = 6 * std::sqrt(shape.area() / points.size());
    for (int i = 0; i < 60; ++i) {
      const Vec3d x = shape.bounds().middle() + random.point(2);
      double nearest = infinity;
      for (const Vec3d& point : points) nearest = std::min(nearest, length(point - x));
      EXPECT_GE(shape.clearance({x, x}), nearest - spacing);
    }
  }
}

TYPED_TEST(EachShape, ShortSegmentsInFreeSpaceHaveClearance) {
  for (const TypeParam& shape : Samples<TypeParam>::about({})) {
    Random random(8);
    for (int i = 0; i < scaled(500); ++i) {
      const Vec3d a = shape.bounds().middle() + random.point(2);
      const double room = shape.clearance({a, a});
      const Vec3d b = a + random.direction() * (0.5 * room);
      EXPECT_GE(shape.clearance({a, b}), 0.5 * room - 1e-12);
    }
  }
}

TYPED_TEST(EachShape, NormalsOfClosedShapesPointOutward) {
  if constexpr (std::is_same_v<TypeParam, Quad>) return;
  for (const TypeParam& shape : Samples<TypeParam>::about({2, 2, 2})) {
    Random random(9);
    for (int i = 0; i < scaled(500); ++i) {
      const SurfacePoint point = shape.sample(random.uniform(0, 1), random.uniform(0, 1));
      // From just outside, another way out crosses the surface an even number of times.
      const Vec3d from = point.position + point.geometric_normal * 1e-7;
      const Vec3d way = normalize(point.geometric_normal + 0.9 * random.direction());
      int crossings = 0;
      double low = 0.0;
      while (const auto contact = shape.intersect({from, way}, low, infinity)) {
        ++crossings;
        low = contact->distance + 1e-9;
      }
      EXPECT_EQ(crossings % 2, 0);
    }
  }
}

TYPED_TEST(EachShape, RaysThatAreNotFiniteMeetNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const TypeParam& shape : Samples<TypeParam>::about({}))
    for (const double bad : {nan, infinity, -infinity, 1e200}) {
      EXPECT_FALSE(shape.intersect({{bad, 0, 0}, {0, 1, 0}}, 0.0, infinity).has_value());
      EXPECT_FALSE(shape.intersect({{0, 0, 0}, {nan, bad, 0}}, 0.0, infinity).has_value());
    }
}

}  // namespace
}  // namespace portalens::test
