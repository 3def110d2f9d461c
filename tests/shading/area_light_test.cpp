#include "shading/area_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "io/read_scene.h"
#include "math/sobol.h"
#include "render/render.h"
#include "support/random.h"
#include "support/scale.h"
#include "support/scene_text.h"
#include "support/shading.h"
#include "world/light_list.h"

namespace portalens::test {
namespace {

using std::numbers::pi;

template <class Lamp>
Lamp lamp_of(const std::string& keys) {
  const Scene scene = read_scene_text("[[light]]\n" + keys, "a.toml");
  Names names;
  Faults faults;
  const std::vector<NamedLight> lights = read_lights(scene.lights, names, faults);
  faults.raise();
  return std::get<Lamp>(lights.front().light);
}

std::string text_of(Vec3d v) {
  return "[" + std::to_string(v.x) + ", " + std::to_string(v.y) + ", " + std::to_string(v.z) + "]";
}

/// The mean over its samples.
template <class Lamp>
double arriving(const Lamp& lamp, Vec3d x, Vec3d normal, std::uint64_t key) {
  constexpr std::uint32_t count = 1 << 17;
  double sum = 0.0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto [u1, u2] = sobol_pair(key, i);
    sum += irradiance(lamp.sample(x, u1, u2), x, normal).x;
  }
  return sum / count;
}

/// The sum over small parts of a flat lamp of radiance 1: cos cos' / d², on its front.
/// @param at  its point for two numbers of [0, 1], and what part of the area is about it
template <class At>
double summed(const At& at, Vec3d direction, Vec3d x, Vec3d normal) {
  constexpr int side = 700;
  double sum = 0.0;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const auto [place, area] = at((i + 0.5) / side, (j + 0.5) / side);
      const Vec3d way = place - x;
      const double square = dot(way, way);
      sum += area * std::fmax(0.0, dot(way, normal)) * std::fmax(0.0, -dot(way, direction)) /
             (square * square);
    }
  return sum / (side * side);
}

TEST(RectangleLight, LightsAsTheSumOverItsPartsDoes) {
  Random random(1);
  for (int i = 0; i < 20; ++i) {
    const Vec3d middle = random.point(2), direction = random.direction();
    const Vec3d hint = random.direction();
    const Vec3d up = normalize(hint - direction * dot(hint, direction));
    const double w = random.uniform(0.2, 3), h = random.uniform(0.2, 3);
    const auto lamp = lamp_of<RectangleLight>(
        "type = \"rectangle\"\nposition = " + text_of(middle) +
        "\ndirection = " + text_of(direction) + "\nup = " + text_of(hint) + "\nsize = [" +
        std::to_string(w) + ", " + std::to_string(h) + "]\nintensity = 1\n");
    Vec3d x = random.point(4);
    if (std::fabs(dot(x - middle, direction)) < 0.3) continue;
    const Vec3d normal = random.direction();
    const double expected = summed(
        [&](double u, double v) {
          return std::pair(middle + cross(up, direction) * ((u - 0.5) * w) + up * ((v - 0.5) * h),
                           w * h);
        },
        direction, x, normal);
    EXPECT_NEAR(arriving(lamp, x, normal, 7), expected, 1e-3 * expected + 1e-6) << i;
  }
}

TEST(DiscLight, LightsAsTheSumOverItsPartsDoes) {
  Random random(2);
  for (int i = 0; i < 20; ++i) {
    const Vec3d middle = random.point(2), direction = random.direction();
    const double radius = random.uniform(0.2, 2);
    const auto lamp = lamp_of<DiscLight>(
        "type = \"disc\"\nposition = " + text_of(middle) + "\ndirection = " + text_of(direction) +
        "\nradius = " + std::to_string(radius) + "\nintensity = 1\n");
    const Vec3d x = random.point(4), normal = random.direction();
    if (std::fabs(dot(x - middle, direction)) < 0.3) continue;
    const Vec3d right = any_perpendicular(direction), up = cross(direction, right);
    const double expected = summed(
        [&](double u, double v) {
          const double r = radius * u, angle = 2 * pi * v;
          return std::pair(middle + (right * std::cos(angle) + up * std::sin(angle)) * r,
                           2 * pi * radius * r);
        },
        direction, x, normal);
    EXPECT_NEAR(arriving(lamp, x, normal, 8), expected, 1e-3 * expected + 1e-6) << i;
  }
}

/// What sees all of it gets what a point of the same intensity gives.
TEST(SphereLight, LightsAsAPointOfItsIntensity) {
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    const Vec3d middle = random.point(2), normal = random.direction();
    const double radius = random.uniform(0.1, 1);
    const std::string where = "position = " + text_of(middle) + "\nintensity = 5\n";
    const auto lamp = lamp_of<SphereLight>(where + "radius = " + std::to_string(radius) + "\n");
    const auto point = lamp_of<PointLight>(where);
    const Vec3d x = middle - normal * (radius * random.uniform(1.05, 3));
    const double expected = irradiance(point.sample(x, 0, 0), x, normal).x;
    EXPECT_NEAR(arriving(lamp, x, normal, 9), expected, 1e-3 * expected);
    EXPECT_NEAR(lamp.power().x, point.power().x, 1e-9 * point.power().x);
  }
}

std::string faults_of(const std::string& keys) {
  try {
    (void)lamp_of<RectangleLight>(keys);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

TEST(AreaLights, SayWhatTheyLack) {
  const std::string panel =
      "type = \"rectangle\"\nposition = [0, 3, 0]\ndirection = [0, -1, 0]\nintensity = 1\n";
  EXPECT_EQ(faults_of(panel + "size = [1, 2]\n"), "");
  EXPECT_NE(faults_of(panel).find("size"), std::string::npos);
  EXPECT_NE(faults_of(panel + "size = [1, -2]\n").find("no two lengths"), std::string::npos);
  EXPECT_NE(faults_of(panel + "size = 1e-12\n").find("too small"), std::string::npos);
  EXPECT_NE(faults_of(panel + "size = 1\nup = [0, 1, 0]\n").find("'up'"), std::string::npos);
  EXPECT_NE(faults_of(panel + "size = 1\nradius = 2\n").find("radius"), std::string::npos);
}

TEST(AreaLights, RefuseWhatIsBeyondNumbers) {
  EXPECT_NE(faults_of("type = \"sphere\"\nposition = [0, 3, 0]\nradius = 1e-8\nintensity = 1e300\n")
                .find("beyond all numbers"),
            std::string::npos);
}

constexpr const char* room =
    "camera = { position = [0, 1, 0.01], look_at = [0, 3, 0], fov = 60 }\n"
    "film = { width = 8, height = 8 }\nsampler = { samples = 1 }\n"
    "shading = { ambient = [0, 0, 0] }\nenvironment = { color = [0, 0, 0] }\n"
    "[[quad]]\nvertices = [[-5, 3, 5], [-5, 3, -5], [5, 3, -5], [5, 3, 5]]\n"
    "[[light]]\nposition = [0, 3, 0]\ndirection = [0, -1, 0]\nintensity = [4, 3, 2]\n";

/// Flush with the ceiling it is met, not the ceiling.
TEST(AreaLights, ALampInACeilingIsSeenThere) {
  for (const std::string kind :
       {"type = \"rectangle\"\nsize = 0.8\n", "type = \"disc\"\nradius = 0.5\n"}) {
    const Image seen = render(compiled(room + kind), {}).image;
    EXPECT_EQ(seen.at(4, 4)[0], 4.0f);
    EXPECT_EQ(seen.at(4, 4)[2], 2.0f);
    EXPECT_LT(seen.at(0, 0)[0], 1.0f);
    const Image unseen = render(compiled(room + kind + "visible = false\n"), {}).image;
    EXPECT_LT(unseen.at(4, 4)[0], 1.0f);
  }
}

/// Whether it is seen makes no difference to what it lights.
TEST(AreaLights, ALampInACeilingLightsTheFloorSeenOrNot) {
  const std::string below =
      "camera = { position = [0, 2.5, 0.01], look_at = [0, 0, 0], fov = 60 }\n"
      "film = { width = 8, height = 8 }\nsampler = { samples = 64 }\n"
      "shading = { ambient = [0, 0, 0] }\nenvironment = { color = [0, 0, 0] }\n"
      "[[quad]]\nvertices = [[-5, 3, 5], [-5, 3, -5], [5, 3, -5], [5, 3, 5]]\n"
      "[[quad]]\nvertices = [[-5, 0, 5], [5, 0, 5], [5, 0, -5], [-5, 0, -5]]\n"
      "[[light]]\ntype = \"disc\"\nradius = 0.5\nposition = [0, 3, 0]\n"
      "direction = [0, -1, 0]\nintensity = 4\n";
  const Image seen = render(compiled(below), {}).image;
  const Image unseen = render(compiled(below + "visible = false\n"), {}).image;
  // Of a disc, straight below its middle: pi L r² / (r² + d²), and the floor gives back half.
  EXPECT_NEAR(seen.at(4, 4)[0], 0.5 * 4 * 0.25 / 9.25, 2e-3);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) EXPECT_EQ(seen.at(x, y)[0], unseen.at(x, y)[0]);
}

/// From behind it is black, and lights nothing.
TEST(AreaLights, ShineOnTheirFrontOnly) {
  const std::string behind =
      "camera = { position = [0, 5, 0.01], look_at = [0, 3, 0], fov = 60 }\n"
      "film = { width = 8, height = 8 }\nsampler = { samples = 1 }\n"
      "shading = { ambient = [0, 0, 0] }\nenvironment = { color = [1, 1, 1] }\n"
      "[[light]]\nposition = [0, 3, 0]\ndirection = [0, -1, 0]\nintensity = 4\n"
      "type = \"disc\"\nradius = 0.5\n";
  const Image seen = render(compiled(behind), {}).image;
  EXPECT_EQ(seen.at(4, 4)[0], 0.0f);
  EXPECT_EQ(seen.at(0, 0)[0], 1.0f);
  const auto lamp = lamp_of<DiscLight>(
      "type = \"disc\"\nposition = [0, 3, 0]\ndirection = [0, -1, 0]\nradius = 0.5\n"
      "intensity = 4\n");
  EXPECT_EQ(irradiance(lamp.sample({0, 5, 0}, 0.3, 0.4), {0, 5, 0}, {0, -1, 0}), Rgb{});
}

}  // namespace
}  // namespace portalens::test
