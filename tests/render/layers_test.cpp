/// \file
/// The layers of a picture.
#include "render/layers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/scene_text.h"

namespace portalens {
namespace {

/// A wall behind a hole that the camera looks at straight.
const std::string hole_before_a_wall = R"([camera]
position = [0, 0, 20]
look_at = [0, 0, 0]
[physics]
min_force = 0
tolerance = 1e-6
[[quad]]
name = "wall"
vertices = [[-90, -90, -30], [90, -90, -30], [90, 90, -30], [-90, 90, -30]]
[[mass]]
name = "hole"
center = [0, 0, 0]
mass = 1000
)";

struct Followed {
  Arrival arrival;
  FirstHit first_hit;
};

Followed followed(const World& world, Vec3d position, Vec3d direction) {
  Photon photon;
  photon.position = position;
  photon.direction = normalize(direction);
  PathTrace path_trace;
  const Arrival arrival = advance_recorded(world.space, photon, path_trace);
  return {arrival, first_hit_of(world, arrival, path_trace)};
}

TEST(ImageOrder, IsOneWhereTheWallIsSeenPastTheOtherSideOfTheHole) {
  const World world = test::compiled(hole_before_a_wall);
  int direct = 0, second = 0;
  for (int i = 0; i < 400; ++i) {
    const double slope = 0.0875 + 0.2 * i / 400;
    const auto [arrival, first_hit] = followed(world, {0, 0, 20}, {0, slope, -1});
    if (arrival.fate != Fate::hit) continue;
    const bool past_the_axis = arrival.position.y < 0.0;
    ASSERT_EQ(first_hit.order, past_the_axis ? 1u : 0u) << slope;
    ++(past_the_axis ? second : direct);
  }
  EXPECT_GT(direct, 50);
  EXPECT_GT(second, 5);
}

TEST(ImageOrder, IsNoughtWhereNothingBends) {
  const World world = test::compiled(R"(camera = { position = [0, 0, 5], look_at = [0, 0, 0] }
mass = [{ name = "far", center = [0.5, 0.5, 0], mass = 1e-9 }]
portal = [{ name = "a", pair = "b", vertices = [[-1, -1, -3], [1, -1, -3], [1, 1, -3], [-1, 1, -3]] },
          { name = "b", pair = "a", vertices = [[1, -1, 3], [-1, -1, 3], [-1, 1, 3], [1, 1, 3]] }]
)");
  // To and fro between facing portals, past the mass each time.
  const auto [arrival, first_hit] = followed(world, {0, 0, 0}, {0.01, 0, -1});
  EXPECT_GT(first_hit.crossings, 10u);
  EXPECT_EQ(first_hit.order, 0u);
}

TEST(FirstHit, TellsTheFirstSurface) {
  const World world = test::compiled(R"(camera = { position = [0, 0, 5], look_at = [0, 0, 0] }
material = [{ name = "red", diffuse = [0.5, 0.25, 0.125] }]
sphere = [{ name = "ball", center = [0, 0, -4], radius = 1, material = "red" }]
portal = [{ name = "a", pair = "b", tint = [0, 1, 0], back = "red", vertices = [
              [9, -1, -3], [11, -1, -3], [11, 1, -3], [9, 1, -3]] },
          { name = "b", pair = "a", vertices = [[-1, -1, 8], [1, -1, 8], [1, 1, 8], [-1, 1, 8]] }]
)");
  const FirstHit ball = followed(world, {0, 0, 0}, {0, 0, -1}).first_hit;
  EXPECT_EQ(ball.depth, 3.0);
  EXPECT_EQ(ball.normal, (Vec3d{0, 0, 1}));
  EXPECT_EQ(ball.albedo, (Rgb{0.5, 0.25, 0.125}));
  EXPECT_EQ(ball.object, 1u);
  EXPECT_EQ(object_names(world)[ball.object - 1], "ball");
  EXPECT_EQ(ball.position, (Vec3d{0, 0, -3}));

  const FirstHit back = followed(world, {10, 0, -9}, {0, 0, 1}).first_hit;
  EXPECT_EQ(object_names(world)[back.object - 1], "a");
  EXPECT_EQ(back.normal, (Vec3d{0, 0, -1}));

  const FirstHit sky = followed(world, {0, 0, 0}, {0, 1, 0}).first_hit;
  EXPECT_EQ(sky.depth, no_depth);
  EXPECT_EQ(sky.object, 0u);
  EXPECT_EQ(sky.fate, Fate::escaped);
  EXPECT_EQ(sky.normal, Vec3d{});
}

}  // namespace
}  // namespace portalens
