#include "shading/sky_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "lanes/engine.h"
#include "math/sobol.h"
#include "shading/light_samples.h"
#include "support/scale.h"
#include "support/scene_text.h"
#include "support/shading.h"

namespace portalens::test {
namespace {

using std::numbers::pi;

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

/// Of a place on a floor, among black balls: all that straight photons find, through one portal at
/// most, since of images in two nothing is asked.
Rgb irradiance_by_photons(const PlannedSpace& space, const Environment& sky, Vec3d x) {
  constexpr int side = 250;
  std::vector<Photon> photons;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const double square = (i + 0.5) / side, around = 2 * pi * (j + 0.5) / side;  // by cosine
      const double sine = std::sqrt(square), up = std::sqrt(1 - square);
      photons.push_back(
          photon_at(x + Vec3d{0, 1e-6, 0}, {sine * std::cos(around), up, sine * std::sin(around)}));
    }
  std::vector<Arrival> arrivals(photons.size());
  advance(space, photons, arrivals, Engine::scalar);
  Rgb sum;
  for (const Arrival& arrival : arrivals)
    if (arrival.fate == Fate::escaped && arrival.crossings < 2)
      sum += sky.radiance(arrival.direction) * arrival.tint;
  return sum * (pi / (side * side));
}

TEST(SkyLight, InRandomPlacesItIsWhatPhotonsSeeOfItThroughPortalsToo) {
  Random random(9);
  double through_portals = 0.0;
  for (int i = 0; i < scaled(12); ++i) {
    std::vector<Shape> shapes{
        Quad(std::array<Vec3d, 4>{{{-20, 0, 20}, {20, 0, 20}, {20, 0, -20}, {-20, 0, -20}}})};
    for (int k = 0; k < 3; ++k) {
      const double radius = random.uniform(0.3, 1.0);
      shapes.emplace_back(
          Sphere({random.uniform(-4, 4), random.uniform(1.1, 4), random.uniform(2, 5)}, radius));
    }
    const double z = random.uniform(-3, -1), width = random.uniform(1, 4);
    auto portals = portal_pair({{-width, 0.1, z}, {width, 0.1, z}, {width, 4, z}, {-width, 4, z}},
                               {{8, 0.1, -width}, {8, 0.1, width}, {8, 4, width}, {8, 4, -width}});
    for (Portal& portal : portals) portal.tint = {0.9, 0.6, 0.3};
    const PlannedSpace space = plain_space(shapes, portals);
    const Environment sky = random_sky(12, 6, 40 + i);
    const Material white = diffuse_material({1, 1, 1}), black = diffuse_material({0, 0, 0});
    Appearance look = appearance_with({white, black}, {SkyLight(sky)}, 4);
    for (std::size_t k = 1; k < 4; ++k) look.bodies[k].material = 1;
    const Vec3d x{random.uniform(-3, 3), 0, random.uniform(-0.5, 1.5)};
    const Rgb expected = irradiance_by_photons(space, sky, x);
    const Arrival arrival = hit_at(x, {0, -1, 0.1});
    for (const Vec3d channel : {Vec3d{1, 0, 0}, {0, 0, 1}}) {
      const Estimate found = estimate(20000, [&](std::uint64_t key) {
        const ShadeOutput output = shade_one(space, look, arrival, key);
        for (const ShadowQuery& query : output.shadows)
          through_portals += query.portal != no_portal && visible(space, query) ? 1 : 0;
        return pi * dot(channel, light_from(space, output));
      });
      EXPECT_NEAR(found.mean, dot(channel, expected), 4.5 * found.error + 3e-3 * found.mean) << i;
    }
  }
  EXPECT_GT(through_portals, 1000);
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
