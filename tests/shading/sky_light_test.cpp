#include "shading/sky_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "math/sobol.h"
#include "shading/light_samples.h"
#include "support/scale.h"
#include "support/scene_text.h"
#include "support/shading.h"

namespace portalens::test {
namespace {

constexpr double pi = std::numbers::pi;

/// A sum over a grid of directions, each times its solid angle.
template <class Term>
Rgb over_all_directions(const Term& term) {
  constexpr int rows = 600, columns = 1200;
  Rgb sum;
  for (int i = 0; i < rows; ++i) {
    const double sine = 1 - (i + 0.5) * 2 / rows, cosine = std::sqrt(1 - sine * sine);
    for (int j = 0; j < columns; ++j) {
      const double azimuth = 2 * pi * (j + 0.5) / columns;
      sum += term({cosine * std::cos(azimuth), sine, cosine * std::sin(azimuth)});
    }
  }
  return sum * (4 * pi / rows / columns);
}

/// Of small and large pictures: what is seen in all directions lights surfaces of all directions.
TEST(SkyLight, LightsASurfaceAsTheSkyThatIsSeenDoes) {
  Random random(1);
  std::uint64_t seed = 100;
  for (const int width : {1, 2, 5, 16, 64})
    for (const int height : {1, 3, 8, 32}) {
      const Environment sky = random_sky(width, height, seed++);
      const SkyLight light(sky);
      const Vec3d normal = random.direction(), x = random.point(5);
      const Rgb expected = over_all_directions(
          [&](Vec3d way) { return sky.radiance(way) * std::fmax(0.0, dot(way, normal)); });
      constexpr std::uint32_t count = 1 << 19;
      Rgb sum;
      for (std::uint32_t i = 0; i < count; ++i) {
        const auto [u1, u2] = sobol_pair(seed, i);
        sum += irradiance(light.sample(x, u1, u2), x, normal);
      }
      EXPECT_LT(length(sum / double{count} - expected), 1e-3 * length(expected))
          << width << " x " << height;
    }
}

/// The density of directions: over the samples, 1 over it has the mean of any part's solid angle.
TEST(SkyLight, ItsSamplesLieAsDenseAsTheySay) {
  constexpr int rows = 4, columns = 6;
  for (const std::uint64_t seed : {11, 12, 13}) {
    Environment sky = random_sky(9, 6, seed);
    for (float& value : std::const_pointer_cast<Image>(sky.image)->pixels) value += 0.01f;
    const SkyLight light(sky);
    Random random(seed);
    const int count = scaled(200000);
    std::vector<double> sums(rows * columns), squares(rows * columns);
    for (int i = 0; i < count; ++i) {
      const LightSample sample = light.sample({}, random.uniform(0, 1), random.uniform(0, 1));
      ASSERT_TRUE(sample.distant);
      ASSERT_NEAR(length(sample.position), 1.0, 1e-12);
      const Rgb seen = sky.radiance(sample.position);
      const double solid_angle = sample.facing.x / seen.x;  // 1 over the density
      EXPECT_NEAR(sample.facing.y / seen.y, solid_angle, 1e-6 * solid_angle);
      const Vec3d way = sample.position;
      const int row = std::min(static_cast<int>((way.y + 1) / 2 * rows), rows - 1);
      const double turned = std::atan2(way.z, way.x) / (2 * pi) + 0.5;
      const int column = std::min(static_cast<int>(turned * columns), columns - 1);
      sums[row * columns + column] += solid_angle;
      squares[row * columns + column] += solid_angle * solid_angle;
    }
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const double mean = sums[i] / count;
      const double error = std::sqrt((squares[i] / count - mean * mean) / count);
      EXPECT_NEAR(mean, 4 * pi / (rows * columns), 4.5 * error);
    }
  }
}

/// A sky whose light is nearly all in one pixel of 32,768: no sample weighs much more than another.
TEST(SkyLight, FindsASmallSunAsSurelyAsALamp) {
  auto image = std::make_shared<Image>(256, 128, 3);
  for (float& value : image->pixels) value = 0.2f;
  for (int c = 0; c < 3; ++c) image->at(40, 30)[c] = 1e5f;
  Environment sky;
  sky.image = image;
  const SkyLight light(sky);
  const double all = 4 * light.power().x;
  Random random(3);
  for (int i = 0; i < 1000; ++i)
    EXPECT_LT(light.sample({}, random.uniform(0, 1), random.uniform(0, 1)).facing.x, 1.3 * all);
}

TEST(SkyLight, APlaceOfThePictureIsSeenInItsDirection) {
  const Environment sky = random_sky(20, 10, 5);
  Random random(6);
  for (int i = 0; i < 1000; ++i) {
    const double right = random.uniform(0, 1), down = random.uniform(0, 1);
    const Rgb seen = sky.radiance(sky.direction_of(right, down));
    EXPECT_LT(length(seen - sky.radiance_at(right, down)), 1e-9 * 400);
  }
}

struct SkyOfAScene : testing::Test {
  static std::size_t lamps(const std::string& sky, const std::string& things) {
    return compiled("camera = { position = [0, 1, 5], look_at = [0, 0, 0] }\nenvironment = { " +
                    sky + " }\n" + things)
        .appearance.lights.size();
  }
  const std::string ball = "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\n";
};

TEST_F(SkyOfAScene, LightsIfItIsAskedAndNotBlackAndSomethingAnswers) {
  EXPECT_EQ(lamps("color = [1, 1, 1]", ball), 0u);
  EXPECT_EQ(lamps("color = [1, 1, 1], lights = true", ball), 1u);
  EXPECT_EQ(lamps("color = [1, 1, 1], lights = true, intensity = 0", ball), 0u);
  EXPECT_EQ(lamps("color = [1, 1, 1], lights = true", ""), 0u);
  EXPECT_EQ(lamps("color = [1, 1, 1], lights = true",
                  ball + "material = \"m\"\n[[material]]\nname = \"m\"\ndiffuse = [0, 0, 0]\n"
                         "reflective = [1, 1, 1]\n"),
            0u);
}

}  // namespace
}  // namespace portalens::test
