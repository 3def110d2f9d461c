// The search for the nearest surface, held against trying everything one by one.
#include "geometry/accelerator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <thread>

#include "geometry/samples.h"
#include "support/infinity.h"
#include "support/scale.h"

namespace portalens::test {
namespace {

std::vector<Shape> one_of_each(Vec3d at) {
  std::vector<Shape> shapes;
  for_each_sample(at, [&](const auto& shape) { shapes.emplace_back(shape); });
  return shapes;
}

/// `count` small shapes of all types, strewn over a cube; no two have faces in one plane.
std::vector<Shape> strewn(Vec3d at, int count) {
  std::vector<Shape> shapes;
  const std::size_t kinds = one_of_each(at).size();
  Random random(99);
  while (static_cast<int>(shapes.size()) < count)
    shapes.push_back(one_of_each(at + random.point(10))[shapes.size() % kinds]);
  return shapes;
}

std::optional<SurfaceHit> nearest_of_all(const std::vector<Shape>& shapes, const Ray& ray,
                                         double low, double high) {
  std::optional<SurfaceHit> best;
  for (std::uint32_t i = 0; i < shapes.size(); ++i) {
    const auto contact =
        std::visit([&](const auto& s) { return s.intersect(ray, low, high); }, shapes[i]);
    if (contact && (!best || contact->distance < best->distance))
      best = SurfaceHit{i, contact->face, contact->distance};
  }
  return best;
}

/// The least of those that `counts` says yes to.
template <class Counts>
double clearance_of(const std::vector<Shape>& shapes, const Segment& segment,
                    const Counts& counts) {
  double least = infinity;
  for (const Shape& shape : shapes)
    if (counts(shape))
      least =
          std::min(least, std::visit([&](const auto& s) { return s.clearance(segment); }, shape));
  return least;
}

bool is_mesh(const Shape& shape) { return std::holds_alternative<Mesh>(shape); }

void expect_same(const std::optional<SurfaceHit>& found, const std::optional<SurfaceHit>& truth) {
  ASSERT_EQ(found.has_value(), truth.has_value());
  if (!found) return;
  EXPECT_EQ(found->distance, truth->distance);
  EXPECT_EQ(found->shape, truth->shape);
  EXPECT_EQ(found->face, truth->face);
}

TEST(Accelerator, FindsToTheBitWhatTryingEveryShapeFinds) {
  for (const double away : {0.0, 1e5})
    for (const int count : {1, 16, 60}) {
      const Vec3d at{away, -away, away};
      const std::vector<Shape> shapes = strewn(at, count);
      const Accelerator accelerator(shapes);
      Random random(1);
      for (int i = 0; i < scaled(17000); ++i) {
        const Ray ray{at + random.point(14), random.direction()};
        const double low = random.uniform(0, 1);
        const double high = i % 2 ? infinity : low + random.uniform(0, 9);
        const auto found = accelerator.nearest(ray, low, high);
        expect_same(found, nearest_of_all(shapes, ray, low, high));
        EXPECT_EQ(accelerator.blocked(ray, low, high), found.has_value());
      }
    }
}

TEST(Accelerator, FindsWhatLiesFarFromTheStartOfTheRay) {
  const std::vector<Shape> shapes = strewn({}, 40);
  const Accelerator accelerator(shapes);
  Random random(2);
  for (int i = 0; i < scaled(5000); ++i) {
    const Vec3d way = random.direction();
    const Ray ray{random.point(6) - way * 1e6, way};
    expect_same(accelerator.nearest(ray, 0, infinity), nearest_of_all(shapes, ray, 0, infinity));
  }
}

TEST(Accelerator, FindsTheTrianglesOfASmallMeshInALargeScene) {
  const Vec3d at{3e4, 1e4, -2e4};
  const std::vector<Shape> shapes = {Sphere({}, 1e5), Mesh(globe(40, at, 0.01, false))};
  const Accelerator accelerator(shapes);
  Random random(3);
  for (int i = 0; i < scaled(2000); ++i) {
    const Vec3d from = at + random.point(0.05);
    const Ray ray{from, normalize(at + random.point(0.01) - from)};
    expect_same(accelerator.nearest(ray, 0, infinity), nearest_of_all(shapes, ray, 0, infinity));
  }
}

TEST(Accelerator, OfSurfacesInOnePlaceTheLaterIsMet) {
  const Mesh mesh(globe(4, {}, 1, false));
  const Sphere sphere({}, 1);
  const std::vector<Shape> shapes = {mesh, sphere, sphere, mesh};
  const Accelerator meshes(shapes), spheres({sphere, sphere});
  Random random(4);
  for (int i = 0; i < 1000; ++i) {
    const Ray ray{random.point(0.3), random.direction()};
    EXPECT_EQ(meshes.nearest(ray, 0, infinity)->shape, 3u);
    EXPECT_EQ(spheres.nearest(ray, 0, infinity)->shape, 1u);
  }
  // A line through a vertex of the globe meets eight triangles there.
  const Accelerator one({mesh});
  const auto hit = one.nearest({{0, 3, 0}, {0, -1, 0}}, 0, infinity);
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->face, nearest_of_all({mesh}, {{0, 3, 0}, {0, -1, 0}}, 0, infinity)->face);
}

TEST(Accelerator, APathNeverMeetsTheFaceItLeavesButDoesMeetTheFarSide) {
  for (const double away : {0.0, 1e5})
    for_each_sample({away, away, 0}, [&](const auto& shape) {
      const Accelerator accelerator({shape});
      Random random(5);
      for (int i = 0; i < scaled(1000); ++i) {
        SurfacePoint start = shape.sample(random.uniform(0, 1), random.uniform(0, 1));
        const Vec3d way = random.direction();
        const Ray probe{start.position, way};
        const auto here = accelerator.contact_near(0, 0, probe, 1e-6);
        if (!here) continue;  // along the surface
        start = accelerator.surface_at(0, here->face, start.position);
        const double slope = dot(way, start.geometric_normal);
        if (std::fabs(slope) < 1e-3) continue;
        const double reach = 1e-6;
        // Starts a little off on either side, as paths that were rounded do.
        const Ray ray{start.position + start.geometric_normal * random.uniform(-1e-10, 1e-10), way};
        const SelfIntersectionGuard guard{0, here->face, slope > 0 ? 1.0 : -1.0, reach};
        const auto next = accelerator.nearest(ray, 0, infinity, guard);
        if (next && next->face == here->face) {
          const auto there = accelerator.surface_at(0, next->face, ray.at(next->distance));
          EXPECT_LT(dot(way, there.geometric_normal) * slope, 0.0) << "met what it left";
        }
        const auto beyond = shape.intersect(ray, reach, infinity);
        if (beyond) {
          ASSERT_TRUE(next.has_value());
          EXPECT_LE(next->distance, beyond->distance);
        }
      }
    });
}

TEST(Accelerator, APathThatLeavesAnEdgeDoesNotMeetTheNeighbouringFace) {
  // Two triangles of one flat square; the path starts on their diagonal.
  const Triangles square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                         {},
                         {},
                         {{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}}, {{{0, 0, 0}, {2, 0, 0}, {3, 0, 0}}}},
                         {}};
  const Accelerator accelerator({Mesh(square)});
  Random random(6);
  for (int i = 0; i < scaled(2000); ++i) {
    const double at = random.uniform(0, 1);
    Vec3d way = random.direction();
    way.z = std::fabs(way.z);
    const auto face = static_cast<std::uint32_t>(i % 2);
    const SelfIntersectionGuard guard{0, face, 1.0, 1e-6};
    EXPECT_FALSE(accelerator.blocked({{at, at, -1e-16}, way}, 0, infinity, guard));
  }
}

TEST(Accelerator, ClearanceIsNeverMoreThanTheDistanceAndNotMuchLess) {
  for (const double away : {0.0, 1e5}) {
    const Vec3d at{-away, 0, away};
    const std::vector<Shape> shapes = strewn(at, 40);
    const Accelerator accelerator(shapes);
    Random random(7);
    for (int i = 0; i < scaled(2000); ++i) {
      const Vec3d x = at + random.point(i % 10 ? 14 : 1e4);
      const double limit = i % 3 ? random.uniform(0, 5) : infinity;
      const double meshes = clearance_of(shapes, {x, x}, is_mesh);
      const double others = clearance_of(shapes, {x, x}, std::not_fn(is_mesh));
      const double found = accelerator.clearance(x, limit);
      EXPECT_LE(found, std::min({limit, meshes, others}) + 1e-12);
      // Of a mesh the distance is known to some cells, which have sides of up to 0.15 here.
      EXPECT_GE(found, std::min({limit, 0.75 * others, 0.75 * meshes - 3.0 * 0.15}) - 1e-12);
    }
  }
}

TEST(Accelerator, NearNeverOverlooksASurfaceAndIsNotAlwaysTrue) {
  const std::vector<Shape> shapes = strewn({}, 40);
  const Accelerator accelerator(shapes);
  Random random(8);
  int near = 0, far = 0;
  for (int i = 0; i < scaled(4000); ++i) {
    const Shape& shape = shapes[random.bits() % shapes.size()];
    const Vec3d a =
        std::visit([](const auto& s) { return s.center_of_mass(); }, shape) + random.point(4);
    const Segment segment{a, a + random.direction() * random.uniform(0, i % 2 ? 0.5 : 10)};
    const double radius = random.uniform(0, 0.5);
    const bool found = accelerator.near(segment, radius);
    // Points along the segment see how near surfaces truly are.
    double distance = infinity;
    for (int step = 0; step <= 20; ++step) {
      const Vec3d x = segment.a + (segment.b - segment.a) * (step / 20.0);
      distance = std::min(distance, accelerator.clearance(x, 20));
    }
    if (distance <= radius) {
      EXPECT_TRUE(found);
    }
    ++(found ? near : far);
  }
  EXPECT_GT(near, scaled(4000) / 20);
  EXPECT_GT(far, scaled(4000) / 20);
}

TEST(Accelerator, ContactNearLooksBothWays) {
  for_each_sample({1, 2, 3}, [&](const auto& shape) {
    const Accelerator accelerator({shape});
    Random random(9);
    for (int i = 0; i < scaled(500); ++i) {
      const Ray ray = ray_towards(shape, random);
      const auto contact = shape.intersect(ray, 0, infinity);
      if (!contact) continue;
      const double off = random.uniform(-1e-3, 1e-3);
      const Ray shifted{ray.at(contact->distance + off), ray.direction};
      const auto found = accelerator.contact_near(0, contact->face, shifted, 2e-3);
      ASSERT_TRUE(found.has_value());
      EXPECT_LE(std::fabs(found->distance), std::fabs(off) + 1e-12);
      EXPECT_LT(shape.clearance({shifted.at(found->distance), shifted.at(found->distance)}), 1e-11);
    }
  });
}

TEST(Accelerator, AnEmptySceneHoldsNothing) {
  const Accelerator accelerator({});
  EXPECT_TRUE(accelerator.bounds().empty());
  EXPECT_FALSE(accelerator.nearest({{0, 0, 0}, {1, 0, 0}}, 0, infinity).has_value());
  EXPECT_FALSE(accelerator.near({{0, 0, 0}, {1, 0, 0}}, 1));
  EXPECT_EQ(accelerator.clearance({0, 0, 0}, 3), 3.0);
  EXPECT_FALSE(Accelerator({Mesh()}).blocked({{0, 0, 0}, {1, 0, 0}}, 0, infinity));
}

TEST(Accelerator, RaysThatAreNotFiniteMeetNothing) {
  const Accelerator accelerator(strewn({}, 40));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {nan, infinity, 1e30, 1e300}) {
    EXPECT_FALSE(accelerator.blocked({{bad, 0, 0}, {0, 1, 0}}, 0, infinity));
    EXPECT_FALSE(accelerator.blocked({{0, bad, 0}, {0, nan, 0}}, 0, infinity));
    EXPECT_FALSE(accelerator.blocked({{0, 0, 0}, {0, 1, 0}}, nan, infinity));
    EXPECT_FALSE(accelerator.blocked({{0, 0, 0}, {0, 1, 0}}, 0, nan));
    EXPECT_GE(accelerator.clearance({bad, 0, 0}, 1.0), 0.0);
    EXPECT_TRUE(accelerator.near({{0, 0, 0}, {bad, 0, 0}}, infinity));
    EXPECT_TRUE(accelerator.near({{bad, bad, 0}, {-bad, 0, 0}}, 1e301));
    EXPECT_FALSE(accelerator.contact_near(0, 0, {{bad, 0, 0}, {0, 1, 0}}, 1.0).has_value());
  }
}

TEST(Accelerator, ThreadsGetTheAnswersThatOneGets) {
  const Accelerator accelerator(strewn({}, 40));
  const auto answers = [&] {
    std::vector<double> found;
    Random random(10);
    for (int i = 0; i < scaled(5000); ++i) {
      const Ray ray{random.point(14), random.direction()};
      const auto hit = accelerator.nearest(ray, 0, infinity);
      found.push_back(hit ? hit->distance : -1.0);
      found.push_back(accelerator.clearance(ray.origin, 2.0));
    }
    return found;
  };
  const auto truth = answers();
  std::vector<std::vector<double>> others(4);
  std::vector<std::thread> threads;
  for (auto& other : others) threads.emplace_back([&] { other = answers(); });
  for (std::thread& thread : threads) thread.join();
  for (const auto& other : others) EXPECT_EQ(other, truth);
}

TEST(Accelerator, AMillionTrianglesAnswerRightly) {
  const int bands = 500;
  const Accelerator accelerator({Mesh(globe(bands, {}, 1, true))});
  const auto& mesh = std::get<Mesh>(accelerator.shapes()[0]);
  EXPECT_GT(mesh.triangle_count(), 990000u);
  Random random(11);
  const double depth = 1 - std::cos(2 * M_PI / bands);  // of the facets below the sphere
  for (int i = 0; i < scaled(3000); ++i) {
    const Ray ray{random.direction() * random.uniform(0.9, 0.99), random.direction()};
    const auto hit = accelerator.nearest(ray, 0, infinity);
    ASSERT_TRUE(hit.has_value());
    const double radius = length(ray.at(hit->distance));
    EXPECT_LE(radius, 1 + 1e-12);
    EXPECT_GE(radius, 1 - depth);
    const double truth = 1 - length(ray.origin), clear = accelerator.clearance(ray.origin, 0.2);
    EXPECT_LE(clear, truth + 1e-12);
    // The cells of this mesh have sides of 0.02.
    EXPECT_GE(clear, 0.75 * (truth - depth) - 3.0 * 0.02);
    EXPECT_TRUE(accelerator.near({ray.origin, ray.origin * 1.12}, 0.001));
    const Vec3d within = ray.origin * 0.6;
    EXPECT_GE(accelerator.clearance(within, 1.0), 0.75 * (1 - length(within)));
    EXPECT_FALSE(accelerator.near({within, within * 0.95}, 0.2));
  }
}

}  // namespace
}  // namespace portalens::test
