/// \file
/// A picture is the same bits however it is taken, and has the radiance that closed forms give.
#include "render/render.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/read_scene.h"
#include "support/busy_scene.h"
#include "support/scene_folder.h"
#include "world/compile.h"

namespace portalens {
namespace {

World world_of(const std::string& text) {
  const SceneFolder folder;
  return compile(read_scene(folder.write("scene.toml", text)));
}

RenderResult taken(const World& world, int threads, int tile,
                   std::optional<Window> crop = std::nullopt) {
  RenderOptions options;
  options.threads = threads;
  options.tile_size = tile;
  options.crop = crop;
  return render(world, options);
}

TEST(Render, ThreadsAndTilesLeaveEveryBitAsItIs) {
  const World world = world_of(test::busy_scene);
  const RenderResult reference = taken(world, 1, 32);
  for (const int threads : {1, 2, 3, 8})
    for (const int tile : {8, 16, 64}) {
      const RenderResult result = taken(world, threads, tile);
      EXPECT_EQ(result.image.pixels, reference.image.pixels)
          << threads << " threads, tiles of " << tile;
      EXPECT_EQ(result.tally.fates, reference.tally.fates);
      EXPECT_EQ(result.tally.steps, reference.tally.steps);
      EXPECT_EQ(result.tally.shadow_queries, reference.tally.shadow_queries);
    }
}

TEST(Render, ACropIsThatPartOfTheWhole) {
  const World world = world_of(test::busy_scene);
  const Image whole = taken(world, 2, 32).image;
  for (const Window& crop : {Window{0, 0, 1, 1}, Window{20, 5, 41, 23}, Window{52, 28, 53, 29}}) {
    const RenderResult part = taken(world, 2, 16, crop);
    ASSERT_EQ(part.image.width, crop.width());
    ASSERT_EQ(part.image.height, crop.height());
    for (int y = 0; y < crop.height(); ++y)
      for (int x = 0; x < crop.width(); ++x)
        for (int channel = 0; channel < 3; ++channel)
          ASSERT_EQ(part.image.at(x, y)[channel], whole.at(crop.x0 + x, crop.y0 + y)[channel]);
  }
}

TEST(Render, EveryPhotonIsCountedUnderOneFate) {
  const World world = world_of(test::busy_scene);
  const Tally tally = taken(world, 2, 32).tally;
  EXPECT_EQ(tally.samples, 53u * 29 * 3);
  EXPECT_GT(tally.photons, tally.samples) << "mirrors send secondary photons";
  std::uint64_t sum = 0;
  for (const std::uint64_t count : tally.fates) sum += count;
  EXPECT_EQ(sum, tally.photons);
  EXPECT_GT(tally.fates[static_cast<int>(Fate::absorbed)], 0u);
  EXPECT_GT(tally.crossings, 0u);
  EXPECT_EQ(tally.not_finite, 0u);
}

TEST(Render, AnotherSeedIsAnotherPictureOfTheSameScene) {
  std::string other = test::busy_scene;
  other.replace(other.find("seed = 5"), 8, "seed = 6");
  const Image a = taken(world_of(test::busy_scene), 2, 32).image,
              b = taken(world_of(other), 2, 32).image;
  EXPECT_NE(a.pixels, b.pixels);
  double sum_a = 0.0, sum_b = 0.0;
  for (const float value : a.pixels) sum_a += value;
  for (const float value : b.pixels) sum_b += value;
  EXPECT_NEAR(sum_a / sum_b, 1.0, 0.05);
}

TEST(Render, AnEmptySceneIsTheEnvironmentExactly) {
  const World world = world_of(R"(
[camera]
position = [0, 0, 5]
look_at = [0, 0, 0]
[film]
width = 9
height = 7
[environment]
color = [0.25, 0.5, 0.75]
)");
  const RenderResult result = taken(world, 2, 4);
  for (int i = 0; i < 9 * 7; ++i) {
    ASSERT_EQ(result.image.pixels[3 * i], 0.25f);
    ASSERT_EQ(result.image.pixels[3 * i + 1], 0.5f);
    ASSERT_EQ(result.image.pixels[3 * i + 2], 0.75f);
  }
  EXPECT_EQ(result.tally.fates[static_cast<int>(Fate::escaped)], 9u * 7 * 4);
}

/// Under light from all round, as bright as the ambient term says, Lambert's law gives ρ times it:
/// a furnace; the mirror's share of the environment adds to it.
TEST(Render, AFurnaceGivesReflectanceTimesItsLight) {
  const World world = world_of(R"(
[camera]
position = [0, 0, 5]
look_at = [0, 0, 0]
fov = 5
[film]
width = 6
height = 6
[shading]
ambient = [0.5, 0.5, 0.5]
[environment]
color = [0.5, 0.5, 0.5]
[[material]]
name = "paint"
diffuse = [0.6, 0.3, 0.0]
reflective = [0.4, 0.2, 0.0]
[[sphere]]
center = [0, 0, 0]
radius = 1.0
material = "paint"
)");
  const RenderResult result = taken(world, 1, 32);
  for (int i = 0; i < 36; ++i) {
    ASSERT_NEAR(result.image.pixels[3 * i], 0.5, 1e-6);
    ASSERT_NEAR(result.image.pixels[3 * i + 1], 0.25, 1e-6);
    ASSERT_EQ(result.image.pixels[3 * i + 2], 0.0f);
  }
}

/// Irradiance under a point light at height h over a plane: I cos³θ / h².
TEST(Render, APlaneUnderAPointLightFollowsTheInverseSquare) {
  const World world = world_of(R"(
[camera]
type = "orthographic"
position = [0, 5, 0]
look_at = [0, 0, 0]
up = [0, 0, -1]
size = 4.0
[film]
width = 5
height = 5
[sampler]
samples = 1
[shading]
ambient = [0, 0, 0]
[[material]]
name = "white"
diffuse = [1, 1, 1]
[[quad]]
vertices = [[-9, 0, 9], [9, 0, 9], [9, 0, -9], [-9, 0, -9]]
material = "white"
[[light]]
position = [0, 2, 0]
intensity = [7, 7, 7]
)");
  const Image image = taken(world, 1, 32).image;
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 5; ++x) {
      const double px = (x - 2) * 0.8, pz = (y - 2) * 0.8;
      const double d2 = px * px + pz * pz + 4.0;
      const double radiance = 7.0 * 2.0 / (d2 * std::sqrt(d2)) / 3.14159265358979323846;
      EXPECT_NEAR(image.at(x, y)[0], radiance, 1e-6 * radiance) << x << ' ' << y;
    }
}

class StopAtOnce : public Cancellation {
 public:
  [[nodiscard]] bool requested() const override { return true; }
};

class Counting : public Progress {
 public:
  void advanced(std::size_t done, std::size_t total, const Tally& tally) override {
    ++calls;
    EXPECT_GT(done, last);
    EXPECT_LE(done, total);
    EXPECT_GE(tally.samples, done);
    last = done;
  }
  int calls = 0;
  std::size_t last = 0;
};

TEST(Render, ProgressIsToldOfEveryTileAndEndsWithTheWhole) {
  const World world = world_of(test::busy_scene);
  Counting progress;
  RenderOptions options;
  options.threads = 2;
  options.tile_size = 16;
  EXPECT_EQ(render(world, options, &progress).completion, Completion::complete);
  EXPECT_EQ(progress.calls, 4 * 2);
  EXPECT_EQ(progress.last, 53u * 29);
}

TEST(Render, ACancelledPictureSaysSo) {
  const World world = world_of(test::busy_scene);
  const StopAtOnce stop;
  const RenderResult result = render(world, {}, nullptr, &stop);
  EXPECT_EQ(result.completion, Completion::cancelled);
  EXPECT_EQ(result.tally.samples, 0u);
}

}  // namespace
}  // namespace portalens
