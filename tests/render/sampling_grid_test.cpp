// What is interpolated between photons is what photons would have found.
#include "render/sampling_grid.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "io/read_scene.h"
#include "lanes/engine.h"
#include "render/render.h"
#include "support/random.h"
#include "support/scale.h"
#include "support/scene_folder.h"
#include "world/compile.h"

namespace portalens {
namespace {

constexpr int side = 128;

const std::string small_film =
    fmt::format("[film]\nwidth = {0}\nheight = {0}\n[sampler]\nsamples = 1\n", side);

/// A ground, a hole and a pair of portals through which it pulls.
std::string scene(const std::string& more = "", int samples = 1) {
  return fmt::format(R"(
[camera]
position = [0.0, 2.5, 13.0]
look_at = [0.0, 1.6, 0.0]
[film]
width = {0}
height = {0}
[sampler]
samples = {1}
[physics]
min_force = 0.2
portal_gravity = "closest-point"
portal_gravity_depth = 1
[[light]]
position = [4, 9, 8]
intensity = [400, 400, 380]
[[quad]]
vertices = [[-30, 0, 30], [30, 0, 30], [30, 0, -30], [-30, 0, -30]]
[[sphere]]
center = [-1.2, 0.6, 2.2]
radius = 0.6
[[mass]]
center = [0.6, 2.7, 1.0]
mass = 150
[[portal]]
name = "orange"
pair = "blue"
vertices = [[-4.6, 0.6, -1.5], [-2.6, 0.6, -1.5], [-2.6, 2.8, -1.5], [-4.6, 2.8, -1.5]]
[[portal]]
name = "blue"
pair = "orange"
vertices = [[2.6, 0.6, -1.5], [4.6, 0.6, -1.5], [4.6, 2.8, -1.5], [2.6, 2.8, -1.5]]
{2}
)",
                     side, samples, more);
}

World world_of(const std::string& text) {
  const SceneFolder folder;
  return compile(read_scene(folder.write("scene.toml", text)));
}

struct Found {
  std::vector<Arrival> own, interpolated;
  Tally tally;
};

/// All pixels, each by its own photon, and by the sampling grid.
Found found_in(const World& world) {
  std::vector<Photon> photons;
  std::vector<FilmPlace> places;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      photons.push_back(camera_photon(world, {x, y, 0}));
      places.push_back({x + 0.5, y + 0.5});
    }
  Found found;
  found.own.resize(photons.size());
  found.interpolated.resize(photons.size());
  advance(world.space, photons, found.own);
  const auto guard = BeamGuard::over(world.space);
  SamplingGrid(world, *guard, {0, 0, side, side}).advance(places, found.interpolated, found.tally);
  return found;
}

TEST(SamplingGrid, FindsWhatPhotonsFindToHundredthsOfAPixel) {
  const World world = world_of(scene());
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

TEST(SamplingGrid, LosesNoBallOfAPixel) {
  for (int i = 0; i < test::scaled(10); ++i) {
    test::Random random(static_cast<std::uint64_t>(31 + i));
    std::string balls;
    for (int k = 0; k < 20; ++k) {
      const double z = random.uniform(-8, 6), radius = random.uniform(0.2, 0.8) * (13 - z) * 0.0055;
      balls += fmt::format("[[sphere]]\ncenter = [{}, {}, {}]\nradius = {}\n",
                           random.uniform(-4, 4), random.uniform(0.3, 4.5), z, radius);
    }
    const Found found = found_in(world_of(scene(balls)));
    int on_balls = 0;
    for (std::size_t k = 0; k < found.own.size(); ++k) {
      const Arrival& own = found.own[k];
      if (own.fate != Fate::hit || own.object < 2) continue;
      ++on_balls;
      EXPECT_EQ(found.interpolated[k].object, own.object)
          << "scene " << i << ", pixel " << k % side << ' ' << k / side;
    }
    EXPECT_GT(on_balls, 5);
    EXPECT_GT(found.tally.interpolated, found.own.size() / 10);
  }
}

/// Pixels of a picture, every photon on its own way, that cross more or fewer portals than it says
/// between others.
int pixels_unlike(const std::string& text) {
  const Found found = found_in(world_of(text));
  EXPECT_GT(found.tally.interpolated, found.own.size() / 10);
  int unlike = 0;
  for (std::size_t i = 0; i < found.own.size(); ++i)
    if (found.own[i].crossings != found.interpolated[i].crossings ||
        found.own[i].object != found.interpolated[i].object)
      ++unlike;
  return unlike;
}

TEST(SamplingGrid, LosesNoPortalThatIsSeenThroughItself) {
  EXPECT_EQ(pixels_unlike(small_film + R"([camera]
position = [0, 0, 1]
look_at = [0, 0, 0]
[[quad]]
vertices = [[-300, -300, -40], [300, -300, -40], [300, 300, -40], [-300, 300, -40]]
[[portal]]
name = "a"
pair = "b"
vertices = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]
[[portal]]
name = "b"
pair = "a"
vertices = [[2.15, 0.15, 100], [0.15, 0.15, 100], [0.15, 2.15, 100], [2.15, 2.15, 100]]
)"),
            0);
}

TEST(SamplingGrid, LosesNoEdgeOfWhatIsSeenAgainBehindAPortal) {
  EXPECT_EQ(pixels_unlike(small_film + R"([camera]
position = [0, 0.17, 20]
look_at = [0, 0.17, 0]
[[quad]]
vertices = [[-6, -0.05, 10], [6, -0.05, 10], [6, 0.03, 0.5], [-6, 0.03, 0.5]]
[[portal]]
name = "a"
pair = "b"
vertices = [[-5, -5, 0], [5, -5, 0], [5, 5, 0], [-5, 5, 0]]
[[portal]]
name = "b"
pair = "a"
vertices = [[-5, 3, -1], [5, 3, -1], [5, 3, 9], [-5, 3, 9]]
)"),
            0);
}

/// Neighbouring paths come out of a slanted portal far from each other.
TEST(SamplingGrid, LosesNoBallAtASlantedExit) {
  const double x = 4 * std::sin(0.17), z = 4 * std::cos(0.17);
  const std::string exit =
      fmt::format("vertices = [[{0}, -2, {1}], [{2}, -2, -{1}], [{2}, 2, -{1}], [{0}, 2, {1}]]\n",
                  20 + x, z, 20 - x);
  int unlike = 0;
  for (int i = 0; i < test::scaled(20); ++i) {
    test::Random random(static_cast<std::uint64_t>(70 + i));
    std::string balls;
    for (int k = 0; k < 12; ++k) {
      const double along = random.uniform(-4, 4);
      balls += fmt::format("[[sphere]]\ncenter = [{}, {}, {}]\nradius = {}\n",
                           20 + 0.17 * along + random.uniform(0.02, 0.4), random.uniform(-2, 2),
                           along, random.uniform(0.01, 0.05));
    }
    unlike += pixels_unlike(small_film + R"([camera]
position = [3.9, 0, 0.7]
look_at = [0, 0, 0]
[[portal]]
name = "a"
pair = "b"
vertices = [[-4, -2, 0], [4, -2, 0], [4, 2, 0], [-4, 2, 0]]
[[portal]]
name = "b"
pair = "a"
)" + exit + balls);
  }
  EXPECT_EQ(unlike, 0);
}

/// Of two heavy bodies the shadow holds images that are a few pixels large.
TEST(SamplingGrid, LosesNoLightWithinShadows) {
  EXPECT_EQ(pixels_unlike(small_film + R"([camera]
position = [0.317477, 1.16812, 13]
look_at = [0, 1.5, 0]
[physics]
min_force = 0.001
c = 12
[[quad]]
vertices = [[-60, -4, 30], [60, -4, 30], [60, -4, -60], [-60, -4, -60]]
[[mass]]
center = [0.801855, 1.97479, -1.72931]
mass = 156.569
[[mass]]
center = [-0.723865, 1.40117, 0.0685343]
mass = 53.5047
horizon = false
core_radius = 0.234546
)"),
            0);
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
    const World world = world_of(scene("", samples));
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
  const Found found = found_in(world_of(scene()));
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
  const World world = world_of(scene());
  RenderOptions options;
  options.photons = Photons::all;
  EXPECT_EQ(render(world, options).tally.interpolated, 0u);
  options.photons = Photons::fewer;
  options.engine = Engine::scalar;
  EXPECT_EQ(render(world, options).tally.interpolated, 0u);
}

}  // namespace
}  // namespace portalens
