/// \file
/// Tiles cover a window once, and the framebuffer keeps what was set.
#include "render/film.h"

#include <gtest/gtest.h>

#include <vector>

#include "render/exposure.h"

namespace portalens {
namespace {

TEST(Tiling, TilesCoverEveryPixelOnce) {
  for (const Window& window : {Window{0, 0, 1, 1}, Window{0, 0, 64, 32}, Window{3, 7, 50, 41}})
    for (const int size : {1, 7, 8, 32, 100}) {
      std::vector<int> seen(window.pixels());
      const Tiling tiles(window, size);
      for (std::size_t i = 0; i < tiles.count(); ++i) {
        const Window tile = tiles[i];
        EXPECT_LE(tile.width(), size);
        EXPECT_LE(tile.height(), size);
        for (int y = tile.y0; y < tile.y1; ++y)
          for (int x = tile.x0; x < tile.x1; ++x)
            ++seen.at((y - window.y0) * window.width() + x - window.x0);
      }
      for (const int count : seen) ASSERT_EQ(count, 1);
    }
}

TEST(Framebuffer, KeepsEachPixelAtItsPlaceInTheWindow) {
  Assignment assignment;
  assignment.film = {0, 0, 100, 100};
  assignment.window = {10, 20, 13, 22};
  assignment.range = {0, 1};
  Framebuffer framebuffer(assignment);
  for (int y = 20; y < 22; ++y)
    for (int x = 10; x < 13; ++x) {
      SampleSum sum;
      sum.add({1.0 * x, 1.0 * y, 0.5});
      framebuffer.set(x, y, sum);
    }
  const Image& image = framebuffer.image();
  ASSERT_EQ(image.width, 3);
  ASSERT_EQ(image.height, 2);
  EXPECT_EQ(image.at(2, 1)[0], 12.0f);
  EXPECT_EQ(image.at(2, 1)[1], 21.0f);
  EXPECT_EQ(image.at(0, 0)[2], 0.5f);
}

}  // namespace
}  // namespace portalens
