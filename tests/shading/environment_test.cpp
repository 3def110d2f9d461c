#include "shading/environment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <string>

#include "io/read_scene.h"
#include "support/random.h"

namespace portalens {
namespace {

/// Red grows to the right from 0 to 1, green grows downwards.
Environment ramp(double rotation = 0.0) {
  auto image = std::make_shared<Image>(720, 360, 3);
  for (int y = 0; y < 360; ++y)
    for (int x = 0; x < 720; ++x) {
      image->at(x, y)[0] = static_cast<float>((x + 0.5) / 720);
      image->at(x, y)[1] = static_cast<float>((y + 0.5) / 360);
    }
  Environment environment;
  environment.image = image;
  environment.rotation = rotation;
  return environment;
}

constexpr double pixel = 1.0 / 360;

TEST(Environment, HasItsCentreAtMinusZ) {
  const Rgb center = ramp().radiance({0, 0, -1});
  EXPECT_NEAR(center.x, 0.5, pixel);
  EXPECT_NEAR(center.y, 0.5, pixel);
}

TEST(Environment, ColorAndIntensityMultiplyThePictureAndIntensityTheColor) {
  Environment sky = ramp();
  const Rgb before = sky.radiance({0, 0, -1});
  sky.scale = {2.0, 0.5, 1.0};
  const Rgb after = sky.radiance({0, 0, -1});
  EXPECT_EQ(after, (Rgb{2.0 * before.x, 0.5 * before.y, before.z}));

  const auto read = [](const std::string& text) {
    const Scene scene = read_scene_text("[environment]\n" + text, "a.toml");
    Faults faults;
    Parameters parameters(scene.environment, faults);
    const ImageLoader load = [](const std::string&, const Location&) {
      return std::make_shared<const Image>(1, 1, 3);
    };
    const Environment environment = Environment::from(parameters, load);
    parameters.finish();
    faults.raise();
    return environment;
  };
  EXPECT_EQ(read("color = [0.25, 0.5, 1]\nintensity = 2\n").color, (Rgb{0.5, 1, 2}));
  EXPECT_EQ(read("image = \"a\"\ncolor = [0.25, 0.5, 1]\nintensity = 2\n").scale, (Rgb{0.5, 1, 2}));
  EXPECT_EQ(read("image = \"a\"\n").scale, (Rgb{1, 1, 1}));
  EXPECT_TRUE(read("image = \"a\"\n").lights);
  EXPECT_FALSE(read("image = \"a\"\nlights = false\n").lights);
  EXPECT_FALSE(read("color = [1, 1, 1]\n").lights);
  EXPECT_TRUE(read("color = [1, 1, 1]\nlights = true\n").lights);
}

TEST(Environment, HasPlusXToTheRightAndPlusYOnTop) {
  EXPECT_NEAR(ramp().radiance({1, 0, 0}).x, 0.75, pixel);
  EXPECT_NEAR(ramp().radiance({-1, 0, 0}).x, 0.25, pixel);
  EXPECT_NEAR(ramp().radiance({0, 1, 0}).y, 0.0, pixel);
  EXPECT_NEAR(ramp().radiance({0, -1, 0}).y, 1.0, pixel);
}

TEST(Environment, HasItsSeamAtPlusZ) {
  EXPECT_NEAR(ramp().radiance(normalize(Vec3d{0.02, 0, 1})).x, 1.0, 0.01);
  EXPECT_NEAR(ramp().radiance(normalize(Vec3d{-0.02, 0, 1})).x, 0.0, 0.01);
}

TEST(Environment, ARotationTurnsTheSkyRightHandedAboutY) {
  test::Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Vec3d d = random.direction();
    if (std::hypot(d.x, d.z) < 0.1) continue;
    const double degrees = random.uniform(-700, 700);
    const double angle = degrees * std::numbers::pi / 180;
    const Vec3d turned{std::cos(angle) * d.x + std::sin(angle) * d.z, d.y,
                       -std::sin(angle) * d.x + std::cos(angle) * d.z};
    const double still = ramp().radiance(d).x, moved = ramp(degrees).radiance(turned).x;
    EXPECT_NEAR(std::remainder(still - moved, 1.0), 0.0, 1e-5);
  }
}

TEST(Environment, WhatIsNoDirectionIsLookedAtNowhereElse) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  for (const Vec3d& d : {Vec3d{none, none, none}, Vec3d{0, none, 1}, Vec3d{none, 0, 1},
                         Vec3d{infinite, -infinite, 0}}) {
    const Rgb found = ramp().radiance(d);  // some colour, or none: no place outside the picture
    EXPECT_FALSE(found.y > 1.0 || found.y < 0.0);
  }
}

TEST(Environment, AColourIsTheSameAllRound) {
  Environment environment;
  environment.color = {1, 2, 3};
  EXPECT_EQ(environment.radiance({0, 1, 0}), (Rgb{1, 2, 3}));
}

}  // namespace
}  // namespace portalens
