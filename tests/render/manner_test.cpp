// What is said of how photons are sent.
#include "render/manner.h"

#include <gtest/gtest.h>

#include "support/scene_text.h"

namespace portalens {
namespace {

const std::string scene = R"(
[[mass]]
center = [0, 0, 0]
mass = 100
[[sphere]]
center = [3, 0, 0]
radius = 0.5
[[cube]]
center = [-3, 0, 0]
size = 1
[[cube]]
center = [-5, 0, 0]
size = 1
)";

std::string entry(const Metadata& metadata, const std::string& name) {
  for (const auto& [key, value] : metadata)
    if (key == "portalens:" + name) return value;
  return "absent";
}

TEST(Manner, OfASceneForLanesNamesThemAndWhatTheyLeave) {
  const Manner manner = manner_of(test::compiled(scene), {});
  EXPECT_EQ(manner.engine, "lanes");
  EXPECT_EQ(manner.why_scalar, "");
  EXPECT_EQ(manner.in_double, "2 cube");
  EXPECT_EQ(manner.photons, "fewer");
  EXPECT_EQ(manner.why_all, "");
  EXPECT_EQ(entry(manner_metadata(manner), "engine"), "lanes");
  EXPECT_EQ(entry(manner_metadata(manner), "engine_because"), "absent");
}

TEST(Manner, OfASceneWithInfiniteInfluencesSaysSo) {
  const World world = test::compiled("[physics]\nmin_force = 0\n" + scene);
  const Metadata metadata = manner_metadata(manner_of(world, {}));
  EXPECT_EQ(entry(metadata, "engine"), "scalar");
  EXPECT_EQ(entry(metadata, "engine_because"),
            "an influence is infinite (physics.min_force = 0; lanes take any that is greater)");
  EXPECT_EQ(entry(metadata, "engine_in_double"), "absent");
  EXPECT_EQ(entry(metadata, "photon_mode"), "all");
  EXPECT_EQ(entry(metadata, "photon_mode_because"), "only lanes know how to send fewer");
}

TEST(Manner, TellsWhatWasAskedFor) {
  const World world = test::compiled(scene);
  RenderOptions options;
  options.photons = Photons::all;
  EXPECT_EQ(manner_of(world, options).why_all, "it is asked for (--photons all)");
  EXPECT_EQ(manner_of(world, options).engine, "lanes");
  options.engine = Engine::scalar;
  EXPECT_EQ(manner_of(world, options).why_scalar, "it is asked for (--engine scalar)");
}

TEST(Manner, OfTooManyThingsToGuardBeamsAgainstIsAllPhotons) {
  std::string many = scene;
  for (int i = 0; i < 260; ++i)
    many += "[[sphere]]\ncenter = [" + std::to_string(i) + ", 9, 0]\nradius = 0.1\n";
  const Manner manner = manner_of(test::compiled(many), {});
  EXPECT_EQ(manner.engine, "lanes");
  EXPECT_EQ(manner.in_double, "2 cube, 69 sphere");
  EXPECT_EQ(manner.photons, "all");
  EXPECT_EQ(manner.why_all,
            "more than 256 surfaces, portals and masses are there to hold beams against");
}

}  // namespace
}  // namespace portalens
