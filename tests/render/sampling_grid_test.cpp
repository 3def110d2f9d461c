// What is interpolated between photons is what photons would have found.
#include "render/sampling_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "render/by_grid.h"
#include "render/render.h"

namespace portalens::test {
namespace {

TEST(SamplingGrid, FindsWhatPhotonsFindToHundredthsOfAPixel) {
  const World world = world_of(ground_hole_and_portals());
  const Found found = found_in(world);
  EXPECT_GT(found.tally.interpolated, found.own.size() / 4);
  const double pixel = 40.0 * 3.14159 / 180.0 / side;
  std::vector<double> misses;
  for (std::size_t i = 0; i < found.own.size(); ++i) {
    const Arrival &own = found.own[i], &other = found.interpolated[i];
    ASSERT_EQ(own.fate, other.fate) << "pixel " << i % side << ' ' << i / side;
    ASSERT_EQ(own.object, other.object);
    ASSERT_EQ(own.crossings, other.crossings);
    if (own.fate == Fate::absorbed) continue;
    misses.push_back(length(own.direction - other.direction) / pixel);
    EXPECT_NEAR(own.turning, other.turning, 1e-3);
    if (own.fate == Fate::escaped) continue;
    misses.push_back(length(own.position - other.position) / own.length / pixel);
    EXPECT_NEAR(own.length, other.length, 1e-3 * own.length);
  }
  std::sort(misses.begin(), misses.end());
  EXPECT_LT(misses[misses.size() * 99 / 100], 0.05);
  EXPECT_LT(misses.back(), 0.5);
}

/// Where masses alone bend light, larger third differences are let pass.
TEST(SamplingGrid, FindsWhatPhotonsFindAroundAHoleToHundredthsOfAPixel) {
  const Found found = found_in(world_of(small_film + R"([camera]
position = [0.0, 2.5, 13.0]
look_at = [0.0, 1.6, 0.0]
[physics]
min_force = 0.1
portal_gravity = "none"
[[quad]]
vertices = [[-30, 0, 30], [30, 0, 30], [30, 0, -30], [-30, 0, -30]]
[[mass]]
center = [0.3, 2.2, 0]
mass = 900
)"));
  EXPECT_GT(found.tally.interpolated, found.own.size() / 2);
  const double pixel = 40.0 * 3.14159 / 180.0 / side;
  std::vector<double> misses;
  for (std::size_t i = 0; i < found.own.size(); ++i) {
    const Arrival &own = found.own[i], &other = found.interpolated[i];
    ASSERT_EQ(own.fate, other.fate) << "pixel " << i % side << ' ' << i / side;
    if (own.fate == Fate::escaped)
      misses.push_back(length(own.direction - other.direction) / pixel);
    if (own.fate == Fate::hit)
      misses.push_back(length(own.position - other.position) / own.length / pixel);
  }
  std::sort(misses.begin(), misses.end());
  EXPECT_LT(misses[misses.size() * 99 / 100], 0.05);
  EXPECT_LT(misses.back(), 0.5);
}

/// At the rim of a wide view a pixel is narrow, and so is what may be smoothed away.
TEST(SamplingGrid, MeasuresPixelsWhereTheyAre) {
  const World world = world_of(small_film + R"([camera]
position = [0, 0, 0]
look_at = [0, 0, -1]
fov = 165.0
[physics]
c = 20.0
min_force = 0.0002
[[quad]]
vertices = [[20, -90, -90], [20, -90, 90], [20, 90, 90], [20, 90, -90]]
[[mass]]
center = [10, 0.7, -2.8]
mass = 0.1
horizon = false
[[mass]]
center = [10, -2.4, -2.8]
mass = 0.1
horizon = false
)");
  const Found found = found_in(world);
  const FilmCamera view(world.camera, side, side);
  std::vector<double> misses;
  for (std::size_t i = 0; i < found.own.size(); ++i) {
    const Arrival &own = found.own[i], &other = found.interpolated[i];
    if (own.fate != Fate::hit || other.fate != Fate::hit) continue;
    const double x = static_cast<double>(i % side), y = static_cast<double>(i / side);
    const double pixel = length(view.ray(x + 1.0, y).direction - view.ray(x, y).direction);
    misses.push_back(length(own.position - other.position) / own.length / pixel);
  }
  std::sort(misses.begin(), misses.end());
  ASSERT_GT(misses.size(), 2000u);
  EXPECT_LT(misses.back(), 1.0);
  EXPECT_LT(misses[misses.size() * 99 / 100], 0.1);
}

TEST(SamplingGrid, LeavesNoTraceOfTilesAndCrops) {
  for (const int samples : {1, 3}) {
    const World world = world_of(ground_hole_and_portals("", samples));
    const auto taken = [&](int tile, std::optional<Window> crop = std::nullopt) {
      RenderOptions options;
      options.tile_size = tile;
      options.crop = crop;
      return render(world, options);
    };
    const RenderResult whole = taken(32);
    EXPECT_GT(whole.tally.interpolated, whole.tally.samples / 4);
    for (const int tile : {5, 64, 200})
      EXPECT_EQ(taken(tile).image.pixels, whole.image.pixels) << "tiles of " << tile;
    const Window crop{13, 71, 54, 102};
    const RenderResult part = taken(32, crop);
    for (int y = crop.y0; y < crop.y1; ++y)
      for (int x = crop.x0; x < crop.x1; ++x)
        for (int channel = 0; channel < 3; ++channel)
          ASSERT_EQ(part.image.at(x - crop.x0, y - crop.y0)[channel],
                    whole.image.at(x, y)[channel]);
  }
}

/// Of so wide a tile only one row of cells is decided at a time.
TEST(SamplingGrid, LeavesNoTraceOfTilesThatAreWide) {
  const World world = world_of(R"([film]
width = 400
height = 16
[sampler]
samples = 2
[camera]
position = [0, 2, 10]
look_at = [0, 2, 0]
[[light]]
position = [4, 9, 8]
intensity = [400, 400, 380]
[[quad]]
vertices = [[-30, 0, 30], [30, 0, 30], [30, 4, -30], [-30, 4, -30]]
[[mass]]
center = [0.6, 2.7, 1.0]
mass = 150
)");
  const auto taken = [&](int tile) {
    RenderOptions options;
    options.tile_size = tile;
    return render(world, options);
  };
  const RenderResult small = taken(64), wide = taken(400);
  EXPECT_EQ(small.image.pixels, wide.image.pixels);
  EXPECT_EQ(small.tally.interpolated, wide.tally.interpolated);
}

/// Samples that nobody tells of, probe rays among them, are what their photons find, to the bit.
TEST(SamplingGrid, ChangesNothingWhereItDoesNotInterpolate) {
  const Found found = found_in(world_of(ground_hole_and_portals()));
  std::size_t same = 0;
  for (std::size_t i = 0; i < found.own.size(); ++i) {
    const Arrival &own = found.own[i], &other = found.interpolated[i];
    if (other.steps == 0) continue;
    ++same;
    EXPECT_EQ(own.steps, other.steps);
    EXPECT_EQ(own.position, other.position);
    EXPECT_EQ(own.direction, other.direction);
    EXPECT_EQ(own.length, other.length);
    EXPECT_EQ(own.turning, other.turning);
  }
  EXPECT_EQ(same + found.tally.interpolated, found.own.size());
}

TEST(SamplingGrid, IsLeftOutWhereAllPhotonsAreAskedFor) {
  const World world = world_of(ground_hole_and_portals());
  RenderOptions options;
  options.photons = Photons::all;
  EXPECT_EQ(render(world, options).tally.interpolated, 0u);
  options.photons = Photons::fewer;
  options.engine = Engine::scalar;
  EXPECT_EQ(render(world, options).tally.interpolated, 0u);
}

}  // namespace
}  // namespace portalens::test
