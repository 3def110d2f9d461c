// Scenes that are valid and extreme: each is taken without a number that is none, every photon with
// one fate; or it is refused with a reason.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "io/image.h"
#include "render/render.h"
#include "support/scene_text.h"

namespace portalens {
namespace {

using test::compiled;

constexpr const char* film = "[film]\nwidth = 6\nheight = 4\n[sampler]\nsamples = 2\n";

/// Against paths that go on and on where portals' reaches cover all.
constexpr const char* few_steps = "[physics]\nmax_steps = 500\n";

std::string camera(double scale) {
  return fmt::format("[camera]\nposition = [0, {}, {}]\nlook_at = [0, 0, 0]\nfov = 50.0\n",
                     0.5 * scale, 6.0 * scale);
}

std::string vertices(double x, double z, double size, double turn) {
  // A square about (x, 0, z), facing +z for turn 1 and -z for turn -1.
  const double h = 0.5 * size;
  return fmt::format("vertices = [[{}, {}, {}], [{}, {}, {}], [{}, {}, {}], [{}, {}, {}]]\n",
                     x - turn * h, -h, z, x + turn * h, -h, z, x + turn * h, h, z, x - turn * h, h,
                     z);
}

/// Two squares of that size, one before the camera and one behind what is seen.
std::string pair(double size, double apart = 3.0) {
  return "[[portal]]\nname = \"a\"\npair = \"b\"\n" + vertices(0, 1, size, 1) +
         "[[portal]]\nname = \"b\"\npair = \"a\"\n" + vertices(apart, -1, size, 1);
}

std::string mass(const std::string& center, double kilograms, const std::string& more = "") {
  return "[[mass]]\ncenter = " + center + fmt::format("\nmass = {}\n", kilograms) + more;
}

const std::string ball = "[[sphere]]\ncenter = [1, 0, -2]\nradius = 1\n";

RenderResult taken(const World& world, Engine engine) {
  RenderOptions options;
  options.threads = 1;
  options.engine = engine;
  return render(world, options);
}

void expect_sound(const RenderResult& result, const std::string& scene) {
  EXPECT_TRUE(std::all_of(result.image.pixels.begin(), result.image.pixels.end(), [](float value) {
    return std::isfinite(value);
  })) << scene;
  const auto& fates = result.tally.fates;
  EXPECT_EQ(std::accumulate(fates.begin(), fates.end(), std::uint64_t{0}), result.tally.photons)
      << scene;
  EXPECT_EQ(result.tally.samples, 6u * 4u * 2u) << scene;
}

/// Takes the scene with both engines.
void expect_taken(const std::string& scene) {
  const World world = compiled(film + scene);
  expect_sound(taken(world, Engine::automatic), scene);
  expect_sound(taken(world, Engine::scalar), scene);
}

/// One or the other.
void expect_taken_or_refused(const std::string& scene) {
  const auto faults = test::faults_of(film + scene);
  for (const Fault& fault : faults) EXPECT_FALSE(fault.remedy.empty()) << to_string(fault);
  if (faults.empty()) expect_taken(scene);
}

/// A mass, a pair of portals, a ball and a lamp, all lengths times `scale`: light takes the same
/// paths, and as much of it.
std::string scaled_scene(double scale) {
  const double s = scale;
  std::string text = camera(s);
  text += fmt::format("[physics]\nmin_force = {}\nmax_length = {}\n", 0.01 / s, 1e6 * s);
  text += fmt::format("[[mass]]\ncenter = [{}, 0, 0]\nmass = {}\n", -1.5 * s, 150.0 * s);
  text += fmt::format("[[sphere]]\ncenter = [{}, 0, {}]\nradius = {}\n", s, -2 * s, s);
  text += fmt::format("[[light]]\nposition = [{}, {}, {}]\nintensity = [{}, {}, {}]\n", -2 * s,
                      4 * s, 3 * s, 20 * s * s, 20 * s * s, 15 * s * s);
  text += "[[portal]]\nname = \"a\"\npair = \"b\"\n" + vertices(0.8 * s, s, 1.2 * s, 1);
  text += "[[portal]]\nname = \"b\"\npair = \"a\"\n" + vertices(4 * s, -s, 1.2 * s, -1);
  return text;
}

TEST(ExtremeScene, AtAnyScaleIsTheSamePicture) {
  const RenderResult one = taken(compiled(film + scaled_scene(1.0)), Engine::scalar);
  for (const double scale : {1e-8, 1e-6, 1e-3, 1.0, 1e3, 1e6, 1e9, 1e11})
    for (const Engine engine : {Engine::scalar, Engine::automatic}) {
      const RenderResult other = taken(compiled(film + scaled_scene(scale)), engine);
      expect_sound(other, scaled_scene(scale));
      double difference = 0.0;
      for (std::size_t i = 0; i < one.image.pixels.size(); ++i)
        difference += std::fabs(double{one.image.pixels[i]} - double{other.image.pixels[i]});
      EXPECT_LT(difference / static_cast<double>(one.image.pixels.size()), 1e-3) << scale;
    }
}

TEST(ExtremeScene, ACameraInABareMassBeforeASkyOfPixels) {
  const test::Folder folder;
  const std::vector<float> gray(64 * 32, 0.5f);
  write_image(folder.path() / "sky.exr", 64, 32, {{"R", gray}, {"G", gray}, {"B", gray}}, {});
  const World world =
      compiled(folder, film + camera(1) + ball + mass("[0, 0.5, 6]", 0.5, "horizon = false\n") +
                           "[environment]\nimage = \"sky.exr\"\n");
  for (const Engine engine : {Engine::automatic, Engine::scalar}) {
    const RenderResult result = taken(world, engine);
    expect_sound(result, "a camera in a bare mass");
    EXPECT_EQ(result.tally.fates[static_cast<std::size_t>(Fate::lost)], result.tally.photons);
    EXPECT_EQ(result.tally.not_finite, 0u);
  }
}

TEST(ExtremeScene, AMassOnAPortalsPlane) {
  for (const char* center :
       {"[0, 0, 1]", "[0.5, 0, 1]", "[0.5, 0.5, 1]", "[0.500001, 0, 1]", "[3, 0, -1]", "[2, 0, 1]"})
    for (const char* coupling : {"none", "closest-point", "shortest-path", "portal-mass"})
      expect_taken_or_refused(camera(1) +
                              fmt::format("{}portal_gravity = \"{}\"\n", few_steps, coupling) +
                              pair(1.0) + ball + mass(center, 100.0));
}

TEST(ExtremeScene, MassesInOnePlaceActAsTheirSum) {
  const std::string before = camera(1) + ball;
  const std::string soft = "core_radius = 0.2\n";
  expect_taken(before + mass("[0, 0, 0]", 50) + mass("[0, 0, 0]", 50));
  const World two = compiled(film + before + mass("[0, 0, 0]", 50, soft) +
                             mass("[0, 0, 0]", 50, soft) + "[physics]\nmin_force = 0\n");
  const World one =
      compiled(film + before + mass("[0, 0, 0]", 100, soft) + "[physics]\nmin_force = 0\n");
  const auto a = taken(two, Engine::scalar).image.pixels;
  const auto b = taken(one, Engine::scalar).image.pixels;
  double difference = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) difference += std::fabs(double{a[i]} - double{b[i]});
  EXPECT_LT(difference / static_cast<double>(a.size()), 1e-3);
}

TEST(ExtremeScene, AnInfluenceThatCoversAll) {
  for (const double least : {1e-6, 1e-12, 1e-30, 1e-300, 0.0})
    for (const char* coupling : {"none", "closest-point", "shortest-path"})
      expect_taken_or_refused(
          camera(1) +
          fmt::format("{}min_force = {}\nportal_gravity = \"{}\"\n", few_steps, least, coupling) +
          pair(1.0) + ball + mass("[0, 0, 0]", 100.0));
}

TEST(ExtremeScene, ACameraWhereTheFieldIsStrongest) {
  for (const char* center : {"[0, 0.5, 5.9]", "[0, 0.5, 6]", "[0, 0, 4]"})
    for (const char* more : {"", "horizon = false\n", "core_radius = 0.5\n"})
      expect_taken(camera(1) + ball + mass(center, 300.0, more));
}

TEST(ExtremeScene, ACameraOnAPortalOrASurface) {
  const std::string looks = "[camera]\nlook_at = [0, 0, -9]\nposition = ";
  for (const char* at : {"[0, 0, 1]", "[0.5, 0, 1]", "[1, 1, -2]", "[1, 0, -2]"})
    expect_taken(looks + at + "\n" + pair(1.0) + ball);
}

TEST(ExtremeScene, PortalsFromTinyToHuge) {
  for (const double size : {1e-9, 1e-3, 1e4, 1e9})
    for (const char* coupling : {"none", "closest-point", "shortest-path", "graviton-map"})
      expect_taken_or_refused(
          camera(1) +
          fmt::format("{}portal_gravity = \"{}\"\ngraviton_resolution = 4\n", few_steps, coupling) +
          pair(size, 3.0 * std::max(1.0, size)) + ball + mass("[0, 1, 0]", 10.0));
}

TEST(ExtremeScene, TwoHundredPortals) {
  std::string portals;
  for (int i = 0; i < 200; ++i) {
    const double x = i % 20 - 10.0, z = -(i / 20);
    portals += fmt::format("[[portal]]\nname = \"p{}\"\npair = \"p{}\"\n", i, i ^ 1) +
               vertices(x, z, 0.8, 1);
  }
  for (const char* coupling :
       {"none", "closest-point", "shortest-path", "portal-mass", "graviton-map"})
    expect_taken_or_refused(
        camera(1) + fmt::format("[physics]\nmax_steps = 3\nportal_gravity = \"{}\"\n", coupling) +
        portals + ball + mass("[0, 1, 0]", 10.0));
}

TEST(ExtremeScene, LightBeyondWhatFilesCanHold) {
  for (const double light : {1e30, 1e38, 1e39, 1e200, 1e300, 1.7e308}) {
    const std::string color = fmt::format("[{0}, {0}, {0}]", light);
    expect_taken_or_refused(camera(1) + ball + "[environment]\ncolor = " + color + "\n");
    expect_taken_or_refused(camera(1) + "[[material]]\nname = \"m\"\nreflective = " + color +
                            "\nemitted = " + color + "\n" + ball + "material = \"m\"\n" +
                            "[[light]]\nposition = [0, 9, 0]\nintensity = " + color + "\n");
    expect_taken_or_refused(camera(1) + ball + mass("[0, 0, 0]", 500.0) +
                            "[physics]\nmax_steps = 3\n[shading]\nlost_color = " + color + "\n");
  }
}

TEST(ExtremeScene, ALightOnASurface) {
  expect_taken(camera(1) + ball + "[[light]]\nposition = [1, 1, -2]\nintensity = [9, 9, 9]\n" +
               "[[light]]\nposition = [1, 0, -1]\nintensity = [9, 9, 9]\n");
}

TEST(ExtremeScene, PhysicsAtItsEnds) {
  for (const char* physics :
       {"G = 0", "G = 1e-300", "G = 1e300", "c = 1e-9", "c = 1e12", "tolerance = 1.0",
        "tolerance = 1e-14\nmax_steps = 100", "max_length = 1e-300", "max_turning = 1e-300",
        "integrator = \"euler\"\nstep = 1e300",
        "integrator = \"rk4\"\nstep = 1e-300\nmax_steps = 10"})
    expect_taken_or_refused(camera(1) + "[physics]\n" + physics + "\n" + ball + pair(1.0) +
                            mass("[0, 0, 0]", 100.0));
}

}  // namespace
}  // namespace portalens
