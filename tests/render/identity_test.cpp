// A pair of portals that maps every point to itself must not be seen.
#include <gtest/gtest.h>

#include <cmath>

#include "render/render.h"
#include "support/scene_text.h"

namespace portalens::test {
namespace {

const char* const room = R"(
[camera]
position = [0.0, 2.0, 12.0]
look_at = [0.0, 1.5, 0.0]
fov = 40.0
[film]
width = 160
height = 90
[physics]
tolerance = 1e-7
min_force = 0.1
portal_gravity = "none"
[shading]
ambient = [0.2, 0.2, 0.2]
[[material]]
name = "floor"
diffuse = [0.7, 0.6, 0.5]
[[material]]
name = "mirror"
diffuse = [0.1, 0.1, 0.1]
reflective = [0.8, 0.8, 0.8]
[[quad]]
vertices = [[-30, 0, 30], [30, 0, 30], [30, 0, -30], [-30, 0, -30]]
material = "floor"
[[sphere]]
center = [-2.0, 1.0, -1.0]
radius = 1.0
material = "mirror"
[[sphere]]
center = [2.5, 0.8, -3.0]
radius = 0.8
material = "floor"
[[mass]]
center = [0.4, 1.8, -1.5]
mass = 150
[[light]]
position = [4, 8, 6]
intensity = [300, 300, 280]
)";

const char* const pair = R"(
[[portal]]
name = "front"
pair = "back"
vertices = [[-2.5, 0.25, 2], [2, 0.25, 2], [2, 3, 2], [-2.5, 3, 2]]
[[portal]]
name = "back"
pair = "front"
vertices = [[2, 0.25, 2], [-2.5, 0.25, 2], [-2.5, 3, 2], [2, 3, 2]]
)";

TEST(Render, APairThatMapsToTheIdentityIsNotSeen) {
  const World without = compiled(room);
  const World with = compiled(std::string(room) + pair);
  RenderOptions options;
  const RenderResult a = render(without, options);
  const RenderResult b = render(with, options);
  ASSERT_GT(b.tally.crossings, 5000u);
  const Image &p = a.image, &q = b.image;
  int unlike = 0;
  const int pixels = p.width * p.height;
  for (int y = 0; y < p.height; ++y)
    for (int x = 0; x < p.width; ++x) {
      double apart = 0.0;
      for (int c = 0; c < 3; ++c)
        apart = std::fmax(apart, std::fabs(p.at(x, y)[c] - q.at(x, y)[c]));
      unlike += apart > 1e-5;
    }
  EXPECT_LE(unlike, std::max(1, pixels / 10000));
}

}  // namespace
}  // namespace portalens::test
