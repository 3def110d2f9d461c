// Lamps on glossy surfaces: asked for and found by photons, together once.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "render/render.h"
#include "shading/metallic_roughness.h"
#include "support/random.h"
#include "support/scene_text.h"

namespace portalens::test {
namespace {

using std::numbers::pi;

/// The middle of a floor, seen from (0, 2, 2).
std::string scene_of(const std::string& lamps, double metallic, double roughness,
                     const std::string& more = "") {
  return "camera = { position = [0, 2, 2], look_at = [0, 0, 0], fov = 0.01 }\n"
         "film = { width = 1, height = 1 }\nsampler = { samples = 8192 }\n"
         "shading = { ambient = [0, 0, 0] }\nenvironment = { color = [0, 0, 0] }\n"
         "material = [{ name = \"f\", base_color = [0.5, 0.5, 0.5], metallic = " +
         std::to_string(metallic) + ", roughness = " + std::to_string(roughness) +
         " }, { name = \"lamp\", diffuse = [0, 0, 0], emitted = [10, 10, 10] }]\n"
         "[[quad]]\nvertices = [[-5, 0, 5], [5, 0, 5], [5, 0, -5], [-5, 0, -5]]\n"
         "material = \"f\"\n" +
         lamps + more;
}

double seen(const std::string& text) { return render(compiled(text), {}).image.at(0, 0)[0]; }

/// What a lamp of a radiance of 10 gives there, by the midpoints of many parts of it.
/// @param part  of (u, v) in the unit square the direction of a part and its solid angle over du dv
double by_quadrature(double metallic, double roughness,
                     const std::function<std::pair<Vec3d, double>(double, double)>& part) {
  const auto here = MetallicRoughness(Constant{{0.5, 0.5, 0.5}}, metallic, roughness).at({});
  const Vec3d up{0, 1, 0}, out = normalize(Vec3d{0, 1, 1});
  constexpr int count = 600;
  double sum = 0.0;
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) {
      const auto [in, angle] = part((i + 0.5) / count, (j + 0.5) / count);
      if (!(in.y > 0.0)) continue;
      const double value = here.value(up, out, in).x + here.glossy(up, out, in).value.x;
      sum += 10 * value / pi * in.y * angle;
    }
  return sum / (double{1} * count * count);
}

/// All directions within that angle of one.
auto cone(Vec3d towards, double half_angle) {
  const Vec3d right = any_perpendicular(towards), up = cross(towards, right);
  return [=](double u, double v) {
    const double depth = 1 - std::cos(half_angle), z = 1 - u * depth, r = std::sqrt(1 - z * z);
    return std::pair(
        right * (r * std::cos(2 * pi * v)) + up * (r * std::sin(2 * pi * v)) + towards * z,
        2 * pi * depth);
  };
}

struct Look {
  double metallic, roughness;
};
constexpr Look looks[] = {{1, 0.1}, {1, 0.35}, {0, 0.2}, {0.5, 0.6}, {1, 1}};

TEST(GlossyLamps, ASphereIsSeenAndAskedForOnce) {
  const Vec3d center{0.2, 2, -2};
  const double radius = 0.3, distance = length(center);
  const auto part = cone(center / distance, std::asin(radius / distance));
  for (const Look& look : looks) {
    const double expected = by_quadrature(look.metallic, look.roughness, part);
    const std::string shape =
        "[[sphere]]\ncenter = [0.2, 2, -2]\nradius = 0.3\nmaterial = \"lamp\"\n";
    EXPECT_NEAR(seen(scene_of(shape, look.metallic, look.roughness)), expected, 0.01 * expected)
        << look.metallic << ' ' << look.roughness;
    // As a lamp: W/sr, and seen or not.
    for (const char* visible : {"true", "false"}) {
      const std::string lamp = "[[light]]\nposition = [0.2, 2, -2]\nradius = 0.3\nintensity = " +
                               std::to_string(10 * pi * radius * radius) +
                               "\nvisible = " + visible + "\n";
      EXPECT_NEAR(seen(scene_of(lamp, look.metallic, look.roughness)), expected, 0.015 * expected)
          << look.metallic << ' ' << look.roughness << ' ' << visible;
    }
  }
}

TEST(GlossyLamps, APanelIsSeenAndAskedForOnce) {
  const Vec3d corner{-0.7, 1.5, -2.5}, side{1.4, 0, 0}, height{0, 1, 0};
  const auto part = [&](double u, double v) {
    const Vec3d way = corner + side * u + height * v;
    const double distance = length(way);
    return std::pair(way / distance, 1.4 * std::fabs(way.z) / (distance * distance * distance));
  };
  for (const Look& look : looks) {
    const double expected = by_quadrature(look.metallic, look.roughness, part);
    const std::string quad =
        "[[quad]]\nvertices = [[-0.7, 1.5, -2.5], [0.7, 1.5, -2.5], [0.7, 2.5, -2.5], [-0.7, 2.5, "
        "-2.5]]\nmaterial = \"lamp\"\n";
    const std::string panel =
        "[[light]]\ntype = \"rectangle\"\nposition = [0, 2, -2.5]\ndirection = [0, 0, 1]\nsize = "
        "[1.4, 1]\nintensity = 10\n";
    for (const std::string& lamp : {quad, panel})
      EXPECT_NEAR(seen(scene_of(lamp, look.metallic, look.roughness)), expected, 0.01 * expected)
          << look.metallic << ' ' << look.roughness << ' ' << lamp;
  }
}

TEST(GlossyLamps, ASunIsSeenAndAskedForOnce) {
  const Vec3d towards = normalize(Vec3d{0.1, 1, -1});
  const double half_angle = 2 * pi / 180;
  for (const Look& look : looks) {
    const double expected = by_quadrature(look.metallic, look.roughness, cone(towards, half_angle));
    const std::string sun =
        "[[light]]\ntype = \"sun\"\ndirection = [-0.1, -1, 1]\nangle = 4\n"
        "intensity = " +
        std::to_string(10 * pi * std::pow(std::sin(half_angle), 2)) + "\n";
    for (const char* visible : {"", "visible = false\n"})
      EXPECT_NEAR(seen(scene_of(sun, look.metallic, look.roughness, visible)), expected,
                  0.015 * expected)
          << look.metallic << ' ' << look.roughness << ' ' << visible;
  }
}

/// In a sky of one colour a surface shows that colour, whoever finds it; and the ground by it.
TEST(GlossyLamps, AWhiteSkyIsGivenBackWhole) {
  for (const Look& look : looks)
    for (const char* found :
         {"ambient = [0, 0, 0] }\nenvironment = { color = [3, 3, 3], lights = true",
          "ambient = [3, 3, 3] }\nenvironment = { color = [3, 3, 3]"}) {
      std::string text = scene_of("", look.metallic, look.roughness);
      text.replace(text.find("base_color = [0.5, 0.5, 0.5]"), 28, "base_color = [1, 1, 1]");
      const std::string dark = "ambient = [0, 0, 0] }\nenvironment = { color = [0, 0, 0]";
      text.replace(text.find(dark), dark.size(), found);
      EXPECT_NEAR(seen(text), 3.0, 0.03) << look.metallic << ' ' << look.roughness << ' ' << found;
    }
}

/// The same lamp behind a door that leads straight on, a hundred to the right.
TEST(GlossyLamps, ShineThroughDoorsAsThroughOpenings) {
  const std::string doors =
      "portal = [{ name = \"in\", pair = \"out\", center = [0, 20, -1], facing = [0, 0, 1], size = "
      "[60, 60] }, { name = \"out\", pair = \"in\", center = [100, 20, -1], facing = [0, 0, -1], "
      "size = [60, 60] }]\n";
  const auto lamps_at = [](int x) {
    const std::string at = std::to_string(x);
    return std::vector<std::string>{
        "[[sphere]]\ncenter = [" + at + ", 2, -2]\nradius = 0.3\nmaterial = \"lamp\"\n",
        "[[light]]\ntype = \"rectangle\"\nposition = [" + at +
            ", 2, -2.5]\ndirection = [0, 0, 1]\nsize = [1.4, 1]\nintensity = 10\n",
        "[[light]]\nposition = [" + at + ", 3, -2]\nintensity = 20\n"};
  };
  const auto here = lamps_at(0), beyond = lamps_at(100);
  for (const Look& look : looks)
    for (std::size_t i = 0; i < here.size(); ++i) {
      const double straight = seen(scene_of(here[i], look.metallic, look.roughness));
      EXPECT_NEAR(seen(doors + scene_of(beyond[i], look.metallic, look.roughness)), straight,
                  0.015 * straight)
          << look.metallic << ' ' << look.roughness << ' ' << here[i];
    }
}

}  // namespace
}  // namespace portalens::test
