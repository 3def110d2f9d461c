// Exposure, white balance and tone curves, held against what docs/scene-files.md says of them.
#include "io/development.h"

#include <gtest/gtest.h>

#include <cmath>

#include "math/vec3.h"

namespace portalens {
namespace {

Vec3d developed_pixel(Vec3d light, const Development& development) {
  Image image(1, 1, 3);
  for (int c = 0; c < 3; ++c)
    image.pixels[c] = static_cast<float>(c == 0 ? light.x : c == 1 ? light.y : light.z);
  const Image out = developed(image, development);
  return {out.pixels[0], out.pixels[1], out.pixels[2]};
}

Development with(Tone tone, double exposure = 0.0) {
  Development development;
  development.tone = tone;
  development.exposure = exposure;
  return development;
}

TEST(Development, ByDefaultNotABitChanges) {
  Image image(2, 1, 3);
  image.pixels = {0.1f, -0.2f, 7e9f, 1e-30f, 0.0f, 1.0f};
  EXPECT_EQ(developed(image, {}).pixels, image.pixels);
}

TEST(Development, AStopIsTwiceTheLight) {
  const Vec3d out = developed_pixel({0.25, 0.5, 3}, with(Tone::linear, 1.0));
  EXPECT_EQ(out, (Vec3d{0.5, 1, 6}));
  EXPECT_EQ(developed_pixel({0.25, 0.5, 3}, with(Tone::linear, -2.0)),
            (Vec3d{0.0625, 0.125, 0.75}));
}

TEST(Development, CurvesGrowFromBlackToWhite) {
  for (const Tone tone : {Tone::filmic, Tone::agx_like}) {
    double before = -1e-6;
    for (double stops = -14; stops <= 12; stops += 0.25) {
      const double light = 0.18 * std::exp2(stops);
      const Vec3d out = developed_pixel({light, light, light}, with(tone));
      EXPECT_NEAR(out.x, out.y, 1e-5) << "gray stays gray";
      EXPECT_NEAR(out.x, out.z, 1e-5);
      EXPECT_GE(out.x, before - 1e-6);
      EXPECT_LE(out.x, 1.0 + 1e-5);
      before = out.x;
    }
    EXPECT_GT(before, 0.99);
    EXPECT_LT(developed_pixel({0, 0, 0}, with(tone)).x, 1e-4);
    EXPECT_LT(developed_pixel({-1, -1, -1}, with(tone)).x, 1e-4) << "less than no light is none";
  }
}

TEST(Development, MiddleGreyStaysUnderTheSigmoidAndTheFitHasItsValues) {
  EXPECT_NEAR(developed_pixel({0.18, 0.18, 0.18}, with(Tone::agx_like)).x, 0.18, 1e-3);
  EXPECT_NEAR(developed_pixel({1, 1, 1}, with(Tone::filmic)).x, 2.54 / 3.16, 1e-6);
}

/// What a channel alone would keep red, goes towards white as film does.
TEST(Development, BrightRedGoesTowardsWhiteUnderTheSigmoidOnly) {
  const Vec3d agx = developed_pixel({60, 0.5, 0.5}, with(Tone::agx_like));
  EXPECT_GT(agx.y, 0.5);
  EXPECT_GT(agx.x, agx.y);
}

TEST(Development, WhiteBalanceMakesItsOwnBlackBodyWhite) {
  // Linear sRGB of black bodies by Planck's law and the CIE 1931 observer, green = 1.
  const struct {
    double kelvin;
    Vec3d color;
  } bodies[] = {
      {2000, {3.7547, 1, 0.0288}}, {3000, {2.0661, 1, 0.3191}}, {10000, {0.8784, 1, 1.4378}}};
  for (const auto& [kelvin, color] : bodies) {
    Development development;
    development.white_balance = kelvin;
    const Vec3d out = developed_pixel(color, development);
    // 6504 K on the locus of black bodies is itself a little redder and bluer than sRGB's white.
    EXPECT_NEAR(out.x / out.y, 1.05, 0.06) << kelvin;
    EXPECT_NEAR(out.z / out.y, 1.05, 0.06) << kelvin;
  }
  Development neutral;
  neutral.white_balance = 6504.0;
  const Vec3d same = developed_pixel({0.3, 0.5, 0.7}, neutral);
  EXPECT_LT(length(same - Vec3d{0.3, 0.5, 0.7}), 1e-6);
}

}  // namespace
}  // namespace portalens
