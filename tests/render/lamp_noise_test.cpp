/// \file
/// The noise of lamps in a whole picture, held against the same picture of many more samples.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "render/render.h"
#include "support/scene_text.h"

namespace portalens::test {
namespace {

const std::string floor_and_camera =
    "camera = { position = [0, 3, 0.01], look_at = [0, 0, 0], fov = 10 }\n"
    "shading = { ambient = [0, 0, 0] }\n"
    "environment = { color = [0, 0, 0] }\n"
    "film = { width = 24, height = 24 }\n"
    "material = [{ name = \"lamp\", diffuse = [0, 0, 0], emitted = [100, 100, 100] },"
    " { name = \"f\", diffuse = [0.5, 0.5, 0.5] }]\n"
    "[[quad]]\nvertices = [[-5, 0, 5], [5, 0, 5], [5, 0, -5], [-5, 0, -5]]\nmaterial = \"f\"\n";

World world_of(const std::string& lamps, int samples, int seed = 0) {
  return compiled("sampler = { samples = " + std::to_string(samples) +
                  ", seed = " + std::to_string(seed) + " }\n" + floor_and_camera + lamps);
}

Image picture(const std::string& lamps, int samples, int seed = 0) {
  return render(world_of(lamps, samples, seed), {}).image;
}

/// Root mean square of the difference over the mean.
double noise(const Image& image, const Image& truth) {
  double squares = 0.0, sum = 0.0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double difference = image.at(x, y)[0] - truth.at(x, y)[0];
      squares += difference * difference, sum += truth.at(x, y)[0];
    }
  const double pixels = double{1} * image.width * image.height;
  return std::sqrt(squares / pixels) / (sum / pixels);
}

struct LampNoise : testing::Test {
  /// At 1, 16 and 64 samples a pixel.
  void expect_noise(const std::string& lamps, double most_at_1, double most_at_64,
                    double most_64_over_16) {
    const Image truth = picture(lamps, 2048, 1);
    EXPECT_LT(noise(picture(lamps, 1), truth), most_at_1);
    const double at_16 = noise(picture(lamps, 16), truth);
    const double at_64 = noise(picture(lamps, 64), truth);
    EXPECT_LT(at_64, most_at_64);
    EXPECT_LT(at_64 / at_16, most_64_over_16);
  }
};

TEST_F(LampNoise, OfASphereIsNextToNothing) {
  expect_noise("[[sphere]]\ncenter = [3, 4, 0]\nradius = 0.3\nmaterial = \"lamp\"\n", 0.06, 0.01,
               0.4);
}

TEST_F(LampNoise, OfACubeIsNextToNothing) {
  expect_noise(
      "[[cube]]\ncenter = [3, 4, 0]\nsize = 0.5\nrotation = [10, 20, 30]\n"
      "material = \"lamp\"\n",
      0.08, 0.01, 0.4);
}

/// A sphere close to the floor, whose lower half fills half of its sky.
TEST_F(LampNoise, OfALargeNearLampFallsFast) {
  expect_noise("[[sphere]]\ncenter = [0.9, 0.7, 0]\nradius = 0.5\nmaterial = \"lamp\"\n", 0.7, 0.03,
               0.4);
}

/// A plate hides part of the lamp from the whole picture.
TEST_F(LampNoise, OfAPenumbraFallsFasterThanOfIndependentSamples) {
  expect_noise(
      "[[quad]]\nvertices = [[2, 4, 1], [4, 4, 1], [4, 4, -1], [2, 4, -1]]\n"
      "material = \"lamp\"\n"
      "[[quad]]\nvertices = [[1.5, 2, 3], [3, 2, 3], [3, 2, -3], [1.5, 2, -3]]\n"
      "material = \"f\"\n",
      1.0, 0.06, 0.42);
}

/// Even, but for a sun of half a degree, which gives next to nothing or twice the light of all the
/// rest.
TEST_F(LampNoise, OfASkyWithASmallSunIsThatOfALamp) {
  for (const float sun : {400.0f, 4e4f}) {
    auto image = std::make_shared<Image>(720, 360, 3);
    for (float& value : image->pixels) value = 0.5f;
    for (int c = 0; c < 3; ++c) image->at(400, 100)[c] = sun;
    Environment sky;
    sky.image = image;
    const auto of_sky = [&](int samples, int seed = 0) {
      World world = world_of("", samples, seed);
      world.appearance.lights = {SkyLight(sky)};
      return render(world, {}).image;
    };
    EXPECT_LT(noise(of_sky(64), of_sky(2048, 1)), 0.05) << sun;
  }
}

}  // namespace
}  // namespace portalens::test
