#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

#include "support/scene_text.h"

namespace portalens {
namespace {

using test::compiled;

Camera camera_of(const std::string& keys) { return compiled("[camera]\n" + keys).camera; }

/// Where on the film a point of the scene is seen.
std::array<double, 2> seen_at(const Camera& camera, Vec3d x, int width, int height) {
  const Vec3d way = x - camera.position;
  const double depth = dot(way, camera.forward);
  const Vec3d corner = camera.ray(0, 0, width, height).direction;
  const double left = dot(corner, camera.right) / dot(corner, camera.forward);
  const double top = dot(corner, camera.up) / dot(corner, camera.forward);
  return {0.5 * width * (1 - dot(way, camera.right) / depth / left),
          0.5 * height * (1 - dot(way, camera.up) / depth / top)};
}

TEST(Camera, LooksStraightAheadInTheMiddleOfTheFilm) {
  const Camera camera = camera_of("position = [1, 2, 3]\nlook_at = [4, -2, 9]\n");
  const Ray ray = camera.ray(480, 270, 960, 540);
  EXPECT_EQ(ray.origin, (Vec3d{1, 2, 3}));
  EXPECT_LT(length(ray.direction - normalize(Vec3d{3, -4, 6})), 1e-15);
}

TEST(Camera, HasRightAsForwardTimesUpAndItsFirstPixelTopLeft) {
  const Camera camera = camera_of("position = [0, 0, 5]\nlook_at = [0, 0, 0]\n");
  EXPECT_LT(length(camera.right - cross(camera.forward, camera.up)), 1e-15);
  EXPECT_LT(length(camera.right - Vec3d{1, 0, 0}), 1e-15);
  const Vec3d corner = camera.ray(0, 0, 100, 50).direction;
  EXPECT_LT(corner.x, 0.0);
  EXPECT_GT(corner.y, 0.0);
}

TEST(Camera, ItsFieldOfViewSpansTheSideItNames) {
  const double half = std::tan(15 * std::numbers::pi / 180);
  using Row = std::tuple<std::string, int, int, std::size_t>;
  for (const auto& [axis, width, height, side] :
       {Row{"x", 200, 100, 0}, Row{"y", 200, 100, 1}, Row{"smaller", 200, 100, 1},
        Row{"larger", 200, 100, 0}, Row{"smaller", 100, 200, 0}, Row{"larger", 100, 200, 1}}) {
    const Camera camera = camera_of(
        "position = [0, 0, 5]\nlook_at = [0, 0, 0]\nfov = 30\nfov_axis = \"" + axis + "\"\n");
    const Vec3d corner = camera.ray(0, 0, width, height).direction;
    const std::array<double, 2> slope{corner.x / corner.z, -corner.y / corner.z};
    EXPECT_NEAR(slope[side], half, 1e-14) << axis;
    EXPECT_NEAR(slope[0] / slope[1], static_cast<double>(width) / height, 1e-13) << axis;
  }
}

TEST(Camera, OrthographicRaysAreParallelAndSpanItsSizeInHeight) {
  const Camera camera =
      camera_of("type = \"orthographic\"\nposition = [0, 0, 5]\nlook_at = [0, 0, 0]\nsize = 4\n");
  const Ray first = camera.ray(0, 0, 200, 100), last = camera.ray(200, 100, 200, 100);
  EXPECT_LT(length(first.origin - Vec3d{-4, 2, 5}), 1e-14);
  EXPECT_LT(length(last.origin - Vec3d{4, -2, 5}), 1e-14);
  EXPECT_EQ(first.direction, last.direction);
  EXPECT_EQ(first.direction, (Vec3d{0, 0, -1}));
}

TEST(Camera, WithoutOneTheWholeSceneIsSeenFromPlusZ) {
  for (const char* film : {"width = 300\nheight = 100\n", "width = 100\nheight = 300\n"}) {
    const World world = compiled("[film]\n" + std::string(film) +
                                 "[[sphere]]\ncenter = [3, 1, -2]\nradius = 2\n"
                                 "[[sphere]]\ncenter = [-7, 0, 4]\nradius = 1\n");
    const Camera& camera = world.camera;
    EXPECT_EQ(camera.forward, (Vec3d{0, 0, -1}));
    EXPECT_GT(camera.position.z, 5.0);
    for (const double x : {-8.0, 5.0})
      for (const double y : {-1.0, 3.0})
        for (const double z : {-4.0, 5.0}) {
          const auto place = seen_at(camera, {x, y, z}, world.film.width, world.film.height);
          EXPECT_GT(std::min(place[0], place[1]), 0.0);
          EXPECT_LT(place[0], world.film.width);
          EXPECT_LT(place[1], world.film.height);
        }
  }
}

TEST(Camera, AnEmptySceneHasOneToo) {
  EXPECT_TRUE(is_finite(compiled("[film]\n").camera.position));
}

}  // namespace
}  // namespace portalens
