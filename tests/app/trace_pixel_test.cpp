/// \file
/// `portalens trace --pixel`: the photons of a picture, asked one by one.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io/image.h"
#include "support/run_program.h"

namespace portalens {
namespace {

using nlohmann::json;

/// A mirror over a floor, a rough one beside it, a lamp, a hole.
const std::string mirror_scene = R"([camera]
position = [0, 1, 6]
look_at = [0, 0.5, 0]
[film]
width = 24
height = 16
[sampler]
samples = 4
[physics]
tolerance = 1e-6
[environment]
color = [0.2, 0.3, 0.5]
[[material]]
name = "mirror"
diffuse = [0.1, 0.1, 0.1]
reflective = [0.7, 0.8, 0.9]
[[material]]
name = "rough"
diffuse = [0.2, 0.1, 0.1]
reflective = [0.6, 0.6, 0.5]
roughness = 0.4
[[sphere]]
name = "ball"
center = [-1, 0.4, 0]
radius = 1
material = "mirror"
[[quad]]
name = "floor"
vertices = [[-9, -0.7, 9], [9, -0.7, 9], [9, -0.7, -9], [-9, -0.7, -9]]
material = "rough"
[[mass]]
name = "hole"
center = [1.5, 0.5, -1]
mass = 300
[[light]]
position = [3, 6, 4]
intensity = [90, 80, 70]
)";

std::vector<json> traced(const SceneFolder& folder, const std::vector<std::string>& arguments) {
  std::vector<std::string> words = {"trace", "scene.toml", "--json"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const Outcome outcome = run_portalens(folder.path(), words);
  EXPECT_EQ(outcome.code, 0) << outcome.errors;
  std::vector<json> answers;
  std::istringstream lines(outcome.output);
  for (std::string line; std::getline(lines, line);) answers.push_back(json::parse(line));
  return answers;
}

/// The pixels of every third column and row.
std::vector<std::string> some_pixels() {
  std::vector<std::string> words;
  for (int y = 0; y < 16; y += 3)
    for (int x = 0; x < 24; x += 3)
      words.insert(words.end(), {"--pixel", std::to_string(x), std::to_string(y)});
  return words;
}

TEST(TracePixel, TheSamplesLightsAddUpToThePicture) {
  const SceneFolder folder;
  folder.write("scene.toml", mirror_scene);
  ASSERT_EQ(
      run_portalens(folder.path(), {"render", "scene.toml", "-o", "a.exr", "--engine", "scalar"})
          .code,
      0);
  Faults faults;
  const auto image = read_image(folder.path() / "a.exr", Location{}, faults);
  ASSERT_TRUE(image);
  std::vector<std::array<double, 3>> sums(48);
  std::size_t bounces = 0;
  for (int sample = 0; sample < 4; ++sample) {
    auto words = some_pixels();
    words.insert(words.end(), {"--sample", std::to_string(sample)});
    const auto answers = traced(folder, words);
    ASSERT_EQ(answers.size(), sums.size());
    for (std::size_t i = 0; i < sums.size(); ++i) {
      bounces += answers[i]["bounces"].size();
      for (int c = 0; c < 3; ++c) sums[i][c] += answers[i]["light"][c].get<double>() / 4.0;
    }
  }
  EXPECT_GT(bounces, 50u);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const float* pixel = image->at(static_cast<int>(i % 8) * 3, static_cast<int>(i / 8) * 3);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sums[i][c], pixel[c], 1e-6 * (1.0 + pixel[c]));
  }
}

TEST(TracePixel, TheCentresPhotonIsTheOnlySampleOfAPixelWithOne) {
  const SceneFolder folder;
  folder.write("scene.toml", mirror_scene);
  EXPECT_EQ(traced(folder, {"--pixel", "5", "9", "--set", "sampler.samples=1"}),
            traced(folder, {"--pixel", "5", "9", "--set", "sampler.samples=1", "--sample", "0"}));
  const json answer = traced(folder, {"--pixel", "0", "0"}).at(0);
  const json corner = traced(folder, {"--pixel", "23", "15"}).at(0);
  EXPECT_NEAR(answer["ray"][3].get<double>(), -corner["ray"][3].get<double>(), 1e-12)
      << "the centres of opposite corners lie alike";
}

TEST(TracePixel, ItsRayPastedIntoRayGoesTheSameWay) {
  const SceneFolder folder;
  folder.write("scene.toml", mirror_scene);
  const json pixel =
      traced(folder, {"--pixel", "18", "7", "--sample", "2", "--bounces", "0", "--path"}).at(0);
  std::vector<std::string> words = {"--path", "--ray"};
  for (const json& number : pixel["ray"]) words.push_back(number.dump());
  const json ray = traced(folder, words).at(0);
  for (const char* key : {"fate", "object", "crossings"}) EXPECT_EQ(ray[key], pixel[key]) << key;
  // A direction is made a unit vector again when it is read.
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(ray["position"][axis].get<double>(), pixel["position"][axis].get<double>(), 1e-6);
  EXPECT_EQ(pixel["path"][0].front(), json({pixel["ray"][0], pixel["ray"][1], pixel["ray"][2]}));
}

TEST(TracePixel, ThePathChangesNothingAndEndsWhereThePhotonDoes) {
  const SceneFolder folder;
  folder.write("scene.toml", mirror_scene);
  auto words = some_pixels();
  const auto without = traced(folder, words);
  words.push_back("--path");
  auto with = traced(folder, words);
  ASSERT_EQ(with.size(), without.size());
  for (std::size_t i = 0; i < with.size(); ++i) {
    EXPECT_EQ(with[i]["path"].back().back(), without[i]["position"]);
    with[i].erase("path");
    EXPECT_EQ(with[i], without[i]);
  }
}

TEST(TracePixel, BouncesStopWhereTheUserSays) {
  const SceneFolder folder;
  folder.write("scene.toml", mirror_scene);
  const std::vector<std::string> ball = {"--pixel", "8", "10"};
  const json all = traced(folder, ball).at(0);
  ASSERT_GE(all["bounces"].size(), 2u) << all;
  EXPECT_EQ(all["bounces"][0]["object"], "ball");
  auto words = ball;
  words.insert(words.end(), {"--bounces", "1"});
  const json one = traced(folder, words).at(0);
  EXPECT_EQ(one["bounces"], json::array({all["bounces"][0]}));
  EXPECT_EQ(one["object"], all["bounces"][1]["object"]);
}

TEST(TracePixel, WhatIsNoPixelOrNoSampleIsRefused) {
  const SceneFolder folder;
  folder.write("scene.toml", mirror_scene);
  const std::vector<std::vector<std::string>> wrong = {{"--pixel", "24", "0"},
                                                       {"--pixel", "0", "16"},
                                                       {"--pixel", "-1", "3"},
                                                       {"--pixel", "3"},
                                                       {"--pixel", "1", "2", "--sample", "4"},
                                                       {"--pixel", "1", "2", "--sample", "-1"},
                                                       {"--sample", "0"},
                                                       {"--pixel", "1", "2", "--rays", "-"}};
  for (const auto& arguments : wrong) {
    std::vector<std::string> words = {"trace", "scene.toml"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    const Outcome outcome = run_portalens(folder.path(), words);
    EXPECT_EQ(outcome.code, 2) << quoted(words);
    EXPECT_FALSE(outcome.errors.empty());
    EXPECT_EQ(outcome.output, "");
  }
}

}  // namespace
}  // namespace portalens
