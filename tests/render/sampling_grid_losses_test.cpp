// What is small, or seen by detours, is not lost between photons.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "render/by_grid.h"
#include "support/random.h"
#include "support/scale.h"

namespace portalens::test {
namespace {

TEST(SamplingGrid, LosesNoBallOfAPixel) {
  for (int i = 0; i < test::scaled(10); ++i) {
    test::Random random(static_cast<std::uint64_t>(31 + i));
    std::string balls;
    for (int k = 0; k < 20; ++k) {
      const double z = random.uniform(-8, 6), radius = random.uniform(0.2, 0.8) * (13 - z) * 0.0055;
      balls += fmt::format("[[sphere]]\ncenter = [{}, {}, {}]\nradius = {}\n",
                           random.uniform(-4, 4), random.uniform(0.3, 4.5), z, radius);
    }
    const Found found = found_in(world_of(ground_hole_and_portals(balls)));
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

}  // namespace
}  // namespace portalens::test
