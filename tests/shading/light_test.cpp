#include "shading/light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/random.h"
#include "support/scale.h"
#include "support/shading.h"

namespace portalens {
namespace {

constexpr double pi = std::numbers::pi;

PointLight point_light(Vec3d position, Rgb intensity) {
  PointLight light;
  light.position = position;
  light.intensity = intensity;
  return light;
}

/// A w × h rectangle in the plane y = `height`, one corner above the origin, as two triangles.
TriangleLight rectangle(double w, double h, double height, Rgb emitted,
                        Shining shining = Shining::both_sides) {
  const Vec3d a{0, height, 0}, b{w, height, 0}, c{w, height, h}, d{0, height, h};
  return TriangleLight("panel", {{a, b, c, emitted}, {a, c, d, emitted}}, shining);
}

/// Irradiance of the origin, facing +y, from one corner's rectangle of radiance 1 at height c:
/// Howell, configuration factor C-11 times pi.
double corner_irradiance(double a, double b, double c) {
  const double x = a / c, y = b / c;
  const double sx = std::sqrt(1 + x * x), sy = std::sqrt(1 + y * y);
  return 0.5 * (x / sx * std::atan(y / sx) + y / sy * std::atan(x / sy));
}

template <class Light>
test::Estimate irradiance_of(const Light& light, Vec3d x, Vec3d n) {
  return test::estimate(test::scaled(40000), [&](std::uint64_t i) {
    return irradiance(light.sample(random_number(i, 0), random_number(i, 1)), x, n).x;
  });
}

TEST(PointLight, GivesIntensityTimesCosineOverTheSquareOfTheDistance) {
  const PointLight light = point_light({0, 3, 4}, {10, 20, 30});
  const Rgb e = irradiance(light.sample(0.5, 0.5), {0, 0, 0}, {0, 1, 0});
  EXPECT_NEAR(e.x, 10 * 0.6 / 25, 1e-14);
  EXPECT_NEAR(e.y, 20 * 0.6 / 25, 1e-14);
  EXPECT_NEAR(e.z, 30 * 0.6 / 25, 1e-14);
}

TEST(PointLight, GivesNothingToTheOtherSide) {
  const PointLight light = point_light({0, 3, 4}, {10, 20, 30});
  EXPECT_EQ(irradiance(light.sample(0, 0), {0, 0, 0}, {0, -1, 0}), Rgb{});
  EXPECT_EQ(irradiance(light.sample(0, 0), light.position, {0, 1, 0}), Rgb{});
}

TEST(TriangleLight, ARectangleGivesItsConfigurationFactor) {
  for (const double height : {0.5, 1.0, 3.0}) {
    const auto e = irradiance_of(rectangle(2, 1, height, {1, 1, 1}), {0, 0, 0}, {0, 1, 0});
    EXPECT_NEAR(e.mean, corner_irradiance(2, 1, height), 4 * e.error);
  }
}

TEST(TriangleLight, ItsTrianglesMayDifferInRadiance) {
  const Vec3d a{0, 1, 0}, b{2, 1, 0}, c{2, 1, 2}, d{0, 1, 2};
  const TriangleLight both("both", {{a, b, c, {5, 0, 0}}, {a, c, d, {1, 0, 0}}},
                           Shining::both_sides);
  const TriangleLight first("first", {{a, b, c, {5, 0, 0}}}, Shining::both_sides);
  const TriangleLight second("second", {{a, c, d, {1, 0, 0}}}, Shining::both_sides);
  const Vec3d x{0.3, 0, -0.2}, n{0, 1, 0};
  const auto e = irradiance_of(both, x, n);
  const auto e1 = irradiance_of(first, x, n), e2 = irradiance_of(second, x, n);
  EXPECT_NEAR(e.mean, e1.mean + e2.mean, 4 * (e.error + e1.error + e2.error));
  EXPECT_DOUBLE_EQ(both.area(), 4.0);
}

TEST(TriangleLight, ShinesOnBothSidesUnlessItIsABack) {
  const Vec3d above{0.5, 2, 0.5}, down{0, -1, 0};
  const Vec3d below{0.5, 0, 0.5}, up{0, 1, 0};
  const auto both = rectangle(1, 1, 1, {1, 1, 1});
  EXPECT_NEAR(irradiance(both.sample(0.3, 0.3), above, down).x,
              irradiance(both.sample(0.3, 0.3), {0.5, 0, 0.5}, up).x, 1e-14);
  // Seen from above the rectangle's corners run clockwise: its back is up there.
  const auto back = rectangle(1, 1, 1, {1, 1, 1}, Shining::back_only);
  EXPECT_GT(irradiance(back.sample(0.3, 0.3), above, down).x, 0.0);
  EXPECT_EQ(irradiance(back.sample(0.3, 0.3), below, up), Rgb{});
}

/// The far half of the sphere would be hidden by the near one: only samples that face x count.
TEST(ShapeLight, ASphereGivesPiTimesTheSquareOfTheSineOfItsHalfAngle) {
  const ShapeLight light("ball", Sphere({0, 3, 0}, 1.5), {2, 2, 2});
  const Vec3d x{0, 0, 0}, n{0, 1, 0};
  const auto e = test::estimate(test::scaled(40000), [&](std::uint64_t i) {
    const LightSample sample = light.sample(random_number(i, 0), random_number(i, 1));
    return dot(sample.normal, x - sample.position) > 0 ? irradiance(sample, x, n).x : 0.0;
  });
  EXPECT_NEAR(e.mean, 2 * pi * 0.25, 4 * e.error);
}

TEST(Light, PointsTakeOneSample) {
  EXPECT_EQ(sample_count(point_light({}, {}), 16), 1u);
  EXPECT_EQ(sample_count(rectangle(1, 1, 1, {1, 1, 1}), 16), 16u);
}

}  // namespace
}  // namespace portalens
