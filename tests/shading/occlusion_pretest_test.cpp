#include "shading/occlusion_pretest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "support/random.h"
#include "support/scale.h"
#include "support/shading.h"

namespace portalens {
namespace {

using test::plain_space;

/// A parallelogram about `middle`, no larger than 2.
Quad random_quad(test::Random& random, Vec3d middle) {
  const Vec3d n = random.direction(), a = any_perpendicular(n), b = cross(n, a);
  const double wide = random.uniform(0.2, 1.4), high = random.uniform(0.2, 1.4);
  const Vec3d corner = middle - a * (0.5 * wide) - b * (0.5 * high);
  return Quad(std::array<Vec3d, 4>{corner, corner + a * wide, corner + a * wide + b * high,
                                   corner + b * high});
}

std::vector<Portal> random_pair(test::Random& random, Vec3d at) {
  const Vec3d there = random.point(4);
  std::vector<Vec3d> a{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, b;
  const Rigid motion = rotation_about({0, 0, 0}, random.point(90));
  for (const int i : {1, 0, 3, 2}) b.push_back(motion.rotate(a[i]) + there);
  for (Vec3d& vertex : a) vertex = vertex + at;
  std::vector<Portal> portals = test::portal_pair(a, b);
  if (random.uniform(0, 1) < 0.5) portals[0].back_material = 0;
  return portals;
}

/// A few things about `at`, some of them over each other.
PlannedSpace random_space(test::Random& random, Vec3d at) {
  const auto place = [&] { return at + random.point(3); };
  std::vector<Shape> shapes;
  for (int i = 0; i < 4; ++i) shapes.push_back(random_quad(random, place()));
  for (int i = 0; i < 2; ++i) shapes.push_back(Sphere(place(), random.uniform(0.2, 1.0)));
  const Vec3d low = place();
  shapes.push_back(Quad(
      std::array<Vec3d, 4>{low, low + Vec3d{2, 0, 0}, low + Vec3d{2, 0, 2}, low + Vec3d{0, 0, 2}}));
  shapes.push_back(Cube(low + Vec3d{1, 1, 1}, {2, 2, 2}, {0, 0, 0}));  // stands on the last
  shapes.push_back(Cube(place(), {1, 0.5, 1.5}, random.point(90)));
  std::vector<Mass> masses(2);
  for (Mass& mass : masses) {
    mass.gm = 1.0;
    mass.center = place();
    mass.horizon_radius = random.uniform(0.1, 0.7);
  }
  masses[1].horizon = false;
  const bool windows = random.uniform(0, 1) < 0.5;
  return plain_space(shapes, windows ? random_pair(random, place()) : std::vector<Portal>{},
                     masses);
}

Vec3d sample_of_some(const PlannedSpace& space, test::Random& random) {
  const Shape& shape = space.surfaces.shapes()[static_cast<std::size_t>(random.uniform(0, 9))];
  const double u1 = random.uniform(0, 1), u2 = random.uniform(0, 1);
  return std::visit([&](const auto& s) { return s.sample(u1, u2).position; }, shape);
}

/// The place that a photon reaches from `from`, and how it leaves towards `to`; or `from`.
ShadowQuery query_where_met(const PlannedSpace& space, Vec3d from, Vec3d toward, Vec3d to) {
  ShadowQuery query;
  query.from = from;
  query.to = to;
  const auto hit = space.surfaces.nearest({from, toward}, 0.0, 1e6);
  if (!hit) return query;
  query.from = from + toward * hit->distance;
  const Vec3d normal =
      space.surfaces.surface_at(hit->shape, hit->face, query.from).geometric_normal;
  const double side = dot(query.to - query.from, normal) < 0.0 ? -1.0 : 1.0;
  query.guard = {hit->shape, hit->face, side, 1e-6 * (length(query.from) + 10.0)};
  return query;
}

/// The same from somewhere; or one from anywhere.
ShadowQuery random_query(const PlannedSpace& space, test::Random& random, Vec3d at) {
  const Vec3d from = at + random.point(5);
  const Vec3d to =
      random.uniform(0, 1) < 0.5 ? sample_of_some(space, random) : at + random.point(5);
  if (random.uniform(0, 1) >= 0.2)
    return query_where_met(space, from, normalize(sample_of_some(space, random) - from), to);
  ShadowQuery query;
  query.from = from;
  query.to = to;
  return query;
}

TEST(OcclusionPretest, WhatItTakesForFreeIsVisible) {
  test::Random random(1);
  int free = 0, visible_ways = 0, from_surfaces = 0;
  for (int i = 0; i < test::scaled(200); ++i) {
    const Vec3d at = random.point(i % 4 == 0 ? 1e6 : 10);
    const PlannedSpace space = random_space(random, at);
    const OcclusionPretest screen(space);
    for (int k = 0; k < 500; ++k) {
      const ShadowQuery query = random_query(space, random, at);
      const bool seen = visible(space, query);
      visible_ways += seen;
      if (!screen.surely_free(query)) continue;
      ASSERT_TRUE(seen) << "space " << i << ", query " << k;
      ++free;
      from_surfaces += query.guard.shape != no_object;
    }
  }
  EXPECT_GT(free, 0.5 * visible_ways);
  EXPECT_GT(from_surfaces, test::scaled(5000));
}

TEST(OcclusionPretest, NarrowedToNeighboursItTakesWhatItTookForFreeAndOnlyVisibleWays) {
  test::Random random(3);
  int free = 0;
  OcclusionPretest near;
  for (int i = 0; i < test::scaled(2000); ++i) {
    const Vec3d at = random.point(i % 4 == 0 ? 1e6 : 10);
    const PlannedSpace space = random_space(random, at);
    const OcclusionPretest screen(space);
    const double spread = std::pow(10.0, random.uniform(-4, 1));
    const Vec3d eye = at + random.point(5), aim = sample_of_some(space, random);
    const Vec3d lamp = at + random.point(8);
    std::vector<ShadowQuery> queries;
    for (int k = 0; k < 20; ++k) {
      const Vec3d toward = normalize(aim + random.point(spread) - eye);
      const Vec3d to = i % 2 == 0 ? lamp : lamp + random.point(spread);
      queries.push_back(query_where_met(space, eye, toward, to));
      if (k % 8 == 7) queries.back().portal = 0;
    }
    near.narrow(screen, queries);
    for (const ShadowQuery& query : queries) {
      if (query.portal != no_portal) {
        ASSERT_FALSE(near.surely_free(query));
        continue;
      }
      if (!near.surely_free(query)) {
        ASSERT_FALSE(screen.surely_free(query)) << "space " << i;
        continue;
      }
      ASSERT_TRUE(visible(space, query)) << "space " << i;
      ++free;
    }
  }
  EXPECT_GT(free, test::scaled(10000));
}

TEST(OcclusionPretest, AQuadThatIsLeftAndALampThatIsReachedDontHideTheWay) {
  const Quad floor(std::array<Vec3d, 4>{{{-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9}}});
  const Quad lamp(std::array<Vec3d, 4>{{{-1, 4, -1}, {1, 4, -1}, {1, 4, 1}, {-1, 4, 1}}});
  const PlannedSpace space = plain_space({floor, lamp, Sphere({5, 1, 0}, 1)});
  const OcclusionPretest screen(space);
  test::Random random(2);
  for (int i = 0; i < 1000; ++i) {
    ShadowQuery query;
    query.to = lamp.sample(random.uniform(0, 1), random.uniform(0, 1)).position;
    query.from = {random.uniform(-3, 3), 0.0, random.uniform(-3, 3)};
    query.guard = {0, 0, 1.0, 1e-5};
    EXPECT_TRUE(screen.surely_free(query));
    const double around = random.uniform(0, 2 * std::numbers::pi), up = random.uniform(0.2, 0.9);
    const double across = std::sqrt(1 - up * up);
    query.from = Vec3d{5, 1, 0} -
                 Vec3d{across * std::fabs(std::cos(around)), -up, across * std::sin(around)};
    query.guard = {2, 0, 1.0, 1e-5};
    const Vec3d normal = query.from - Vec3d{5, 1, 0}, way = query.to - query.from;
    if (dot(normal, way) <= 0.01 * length(way)) continue;
    EXPECT_TRUE(screen.surely_free(query));
  }
}

TEST(OcclusionPretest, OnlyWhoLeavesAQuadUpwardsIsFreeOfItThere) {
  const Quad floor(std::array<Vec3d, 4>{{{-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9}}});
  const PlannedSpace space = plain_space({floor});
  ShadowQuery query;
  query.from = {0.3, 0, 0.2};
  query.to = {1, 4, 0};
  std::vector<ShadowQuery> queries(3, query);
  for (ShadowQuery& each : queries) each.guard = {0, 0, 1.0, 1e-5};
  OcclusionPretest near;
  near.narrow(OcclusionPretest(space), queries);
  EXPECT_TRUE(near.surely_free(queries[1]));
  for (const SelfIntersectionGuard& other :
       {SelfIntersectionGuard{}, SelfIntersectionGuard{0, 0, -1.0, 1e-5}}) {
    queries[1].guard = other;
    near.narrow(OcclusionPretest(space), queries);
    EXPECT_FALSE(near.surely_free(queries[1]));
  }
}

TEST(OcclusionPretest, LeavesManyThingsAndWaysThroughPortalsToOthers) {
  ShadowQuery query;
  query.from = {0, 9, 0};
  query.to = {0, 9, 5};
  std::vector<Shape> shapes(20, Sphere({0, 0, 0}, 1));
  EXPECT_TRUE(OcclusionPretest(plain_space(shapes)).surely_free(query));
  query.portal = 0;
  EXPECT_FALSE(OcclusionPretest(plain_space(shapes)).surely_free(query));
  query.portal = no_portal;
  shapes.resize(200, Sphere({0, 0, 0}, 1));
  EXPECT_FALSE(OcclusionPretest(plain_space(shapes)).surely_free(query));
}

TEST(OcclusionPretest, WaysThatAreNoWaysAreLeftToOthers) {
  const PlannedSpace space = plain_space({Sphere({0, 0, 0}, 1)});
  const OcclusionPretest screen(space);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const Vec3d odd : {Vec3d{nan, 5, 5}, Vec3d{5, infinity, 5}, Vec3d{5, 5, 5}}) {
    ShadowQuery query;
    query.from = {5, 5, 5};
    query.to = odd;
    EXPECT_FALSE(screen.surely_free(query));
    OcclusionPretest near;
    EXPECT_FALSE(near.surely_free(query));
    near.narrow(screen, std::array{query});
    EXPECT_TRUE(!near.surely_free(query) || visible(space, query));
  }
}

}  // namespace
}  // namespace portalens
