#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shading/light_samples.h"
#include "support/random.h"
#include "support/scale.h"
#include "support/shading.h"

namespace portalens {
namespace {

using test::panel;

using std::numbers::pi;
const Texture white = Constant{{1, 1, 1}};

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
    return irradiance(light.sample(x, random_number(i, 0), random_number(i, 1)), x, n).x;
  });
}

TEST(PointLight, GivesIntensityTimesCosineOverTheSquareOfTheDistance) {
  const PointLight light = PointLight{{0, 3, 4}, {10, 20, 30}};
  const Rgb e = irradiance(light.sample({}, 0.5, 0.5), {0, 0, 0}, {0, 1, 0});
  EXPECT_NEAR(e.x, 10 * 0.6 / 25, 1e-14);
  EXPECT_NEAR(e.y, 20 * 0.6 / 25, 1e-14);
  EXPECT_NEAR(e.z, 30 * 0.6 / 25, 1e-14);
}

TEST(PointLight, GivesNothingToTheOtherSide) {
  const PointLight light = PointLight{{0, 3, 4}, {10, 20, 30}};
  EXPECT_EQ(irradiance(light.sample({}, 0, 0), {0, 0, 0}, {0, -1, 0}), Rgb{});
  EXPECT_EQ(irradiance(light.sample({}, 0, 0), light.position, {0, 1, 0}), Rgb{});
}

TEST(MeshLight, ARectangleGivesItsConfigurationFactor) {
  for (const double height : {0.5, 1.0, 3.0}) {
    const auto e = irradiance_of(panel(2, 1, height, white), {0, 0, 0}, {0, 1, 0});
    EXPECT_NEAR(e.mean, corner_irradiance(2, 1, height), 4 * e.error);
  }
}

TEST(MeshLight, ItsTrianglesMayDifferInRadiance) {
  const Mesh mesh = test::rectangle_mesh(2, 2, 1);
  const auto with = [&](Rgb first, Rgb second) {
    return MeshLight(mesh, {Constant{first}, Constant{second}},
                     [&](std::uint32_t face) -> std::optional<std::uint32_t> {
                       const Rgb emitted = face == 0 ? first : second;
                       return emitted == Rgb{} ? std::nullopt : std::optional(face);
                     });
  };
  const MeshLight both = with({5, 0, 0}, {1, 0, 0});
  const Vec3d x{0.3, 0, -0.2}, n{0, 1, 0};
  const auto e = irradiance_of(both, x, n);
  const auto e1 = irradiance_of(with({5, 0, 0}, {}), x, n);
  const auto e2 = irradiance_of(with({}, {1, 0, 0}), x, n);
  EXPECT_NEAR(e.mean, e1.mean + e2.mean, 4 * (e.error + e1.error + e2.error));
  EXPECT_DOUBLE_EQ(both.area(), 4.0);
  EXPECT_NEAR(both.power().x, 2 * pi * (5 * 2 + 1 * 2), 1e-12);
}

TEST(PortalBackLight, ShinesOnItsOwnSideAsAMeshDoesOnBoth) {
  const Vec3d above{0.5, 2, 0.5}, down{0, -1, 0};
  const Vec3d below{0.5, 0, 0.5}, up{0, 1, 0};
  const auto both = panel(1, 1, 1, white);
  const auto back = test::back(1, 1, 1, white);
  const auto e = irradiance_of(both, below, up), e_above = irradiance_of(both, above, down);
  EXPECT_NEAR(e.mean, e_above.mean, 4 * (e.error + e_above.error));
  const auto e_back = irradiance_of(back, below, up);
  EXPECT_NEAR(e_back.mean, e.mean, 4 * (e.error + e_back.error));
  EXPECT_EQ(irradiance(back.sample(above, 0.3, 0.3), above, down), Rgb{});
  EXPECT_NEAR(back.power().x, pi, 1e-12);
}

TEST(ShapeLight, ASphereGivesPiTimesTheSquareOfTheSineOfItsHalfAngle) {
  const ShapeLight light(Sphere({0, 3, 0}, 1.5), Constant{{2, 2, 2}});
  const auto e = irradiance_of(light, {0, 0, 0}, {0, 1, 0});
  EXPECT_NEAR(e.mean, 2 * pi * 0.25, 4 * e.error);
}

/// Of a lamp of one radiance that lies above the horizon as a whole, only the cosine differs from
/// sample to sample.
TEST(ShapeLight, WhatIsDrawnAsItIsSeenHardlyDiffers) {
  const Texture glow = Constant{{1, 1, 1}};
  const std::array<Vec3d, 4> corners{{{-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}}};
  const std::vector<ShapeLight> lights{ShapeLight(Sphere({0, 3, 0}, 0.5), glow),
                                       ShapeLight(Cube({0, 3, 0}, {1, 1, 1}, {10, 20, 30}), glow),
                                       ShapeLight(Quad(corners), glow)};
  for (const ShapeLight& light : lights) {
    double low = 1e9, high = 0.0;
    for (std::uint64_t i = 0; i < 1000; ++i) {
      const LightSample sample = light.sample({}, random_number(i, 0), random_number(i, 1));
      low = std::min(low, sample.facing.x);
      high = std::max(high, sample.facing.x);
    }
    EXPECT_NEAR(low, high, 1e-9 * high);
  }
}

/// Beside a wall that shines, and within a sphere and a cube that do.
TEST(ShapeLight, FromWithinAndFromNearByItIsRight) {
  const Texture glow = Constant{{1, 1, 1}};
  for (const Vec3d x : {Vec3d{}, {0.3, 0.2, -0.4}}) {
    const auto sphere = irradiance_of(ShapeLight(Sphere({}, 1), glow), x, {0, 1, 0});
    EXPECT_NEAR(sphere.mean, pi, 4 * sphere.error);
    const auto cube = irradiance_of(ShapeLight(Cube({}, {2, 3, 2}, {}), glow), x, {0, 1, 0});
    EXPECT_NEAR(cube.mean, pi, 4 * cube.error);
  }
  const std::array<Vec3d, 4> wide{{{-1e5, 1, -1e5}, {1e5, 1, -1e5}, {1e5, 1, 1e5}, {-1e5, 1, 1e5}}};
  const auto wall = irradiance_of(ShapeLight(Quad(wide), glow), {3, 0, 2}, {0, 1, 0});
  EXPECT_NEAR(wall.mean, pi, 4 * wall.error + 1e-4);
}

/// Squares of a checker are rectangles, each with its configuration factor.
TEST(ShapeLight, ACheckerGivesTheSumOfItsSquares) {
  const double height = 1.0;
  const std::array<Vec3d, 4> corners{
      {{0, height, 0}, {2, height, 0}, {2, height, 2}, {0, height, 2}}};
  const ShapeLight light(Quad(corners), Checker{{7, 7, 7}, {1, 1, 1}, 1.0});
  const auto factor = [&](double a, double b) { return corner_irradiance(a, b, height); };
  const double corner = factor(1, 1), sides = 2 * (factor(2, 1) - factor(1, 1));
  const double far = factor(2, 2) - corner - sides;
  const auto e = irradiance_of(light, {0, 0, 0}, {0, 1, 0});
  EXPECT_NEAR(e.mean, 7 * (corner + far) + 1 * sides, 4 * e.error);
  EXPECT_NEAR(light.power().x, 2 * pi * 4 * 4, 1e-3 * 100);
}

/// The integral over the rectangle of what its texture has there, by many points.
double irradiance_by_brute_force(double w, double h, double height, const Texture& emitted) {
  const Mesh mesh = test::rectangle_mesh(w, h, height);
  constexpr int steps = 400;
  double sum = 0.0;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      SurfacePoint point;
      point.u = (i + 0.5) / steps;
      point.v = (j + 0.5) / steps;
      const Vec3d x{w * point.u, height, h * point.v};
      sum += color_at(emitted, point).x * height * height / std::pow(dot(x, x), 2);
    }
  return sum * w * h / (steps * steps);
}

TEST(MeshLight, APictureGivesTheIntegralOverIt) {
  const auto picture = test::gradient();
  const double expected = irradiance_by_brute_force(2, 1, 0.7, picture);
  const auto e = irradiance_of(panel(2, 1, 0.7, picture), {0, 0, 0}, {0, 1, 0});
  EXPECT_NEAR(e.mean, expected, 4 * e.error + 1e-4 * expected);
}

/// The back has the portal's own coordinates: u from its first vertex, v from there to the last.
TEST(PortalBackLight, APictureGivesTheIntegralOverIt) {
  const auto picture = test::gradient();
  auto flipped = std::make_shared<Image>(3, 2, 3);
  for (int i = 0; i < 6; ++i)
    std::copy_n(picture.image->at(i % 3, i / 3), 3, flipped->at(i % 3, 1 - i / 3));
  const double expected = irradiance_by_brute_force(2, 1, 0.7, Picture{flipped});
  const auto e = irradiance_of(test::back(2, 1, 0.7, picture), {0, 0, 0}, {0, 1, 0});
  EXPECT_NEAR(e.mean, expected, 4 * e.error + 1e-4 * expected);
}

}  // namespace
}  // namespace portalens
