/// \file
/// `portalens render --layers`, and what `--stats` says of lost photons.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io/image.h"
#include "support/random.h"
#include "support/run_program.h"
#include "support/scale.h"

namespace portalens {
namespace {

using nlohmann::json;

const std::string layered_scene = R"([camera]
position = [0, 1, 6]
look_at = [0, 0.5, 0]
fov = 70
[film]
width = 40
height = 30
[sampler]
samples = 2
[physics]
portal_gravity = "none"
[[material]]
name = "squares"
diffuse = { checker = [[0.9, 0.8, 0.7], [0.1, 0.2, 0.3]], size = 1 }
[[quad]]
name = "floor"
vertices = [[-9, -2, 9], [9, -2, 9], [9, -2, -9], [-9, -2, -9]]
material = "squares"
[[sphere]]
name = "ball"
center = [2, 0, -3]
radius = 1
[[portal]]
name = "in"
pair = "out"
vertices = [[-4, -1, -2], [-2, -1, -2], [-2, 2, -2], [-4, 2, -2]]
back = "squares"
[[portal]]
name = "out"
pair = "in"
vertices = [[1, 3, -4], [3, 3, -4], [3, 6, -4], [1, 6, -4]]
back = "squares"
[[mass]]
name = "hole"
center = [0, 1, 0]
mass = 400
)";

const std::string every_layer_word =
    "depth,normal,albedo,object,fate,steps,turning,crossings,order,position";

const std::map<std::string, std::vector<std::string>> channels_of_layer = {
    {"depth", {"depth.Z"}},
    {"normal", {"N.X", "N.Y", "N.Z"}},
    {"albedo", {"albedo.R", "albedo.G", "albedo.B"}},
    {"object", {"object.X"}},
    {"fate", {"fate.X"}},
    {"steps", {"steps.X"}},
    {"turning", {"turning.X"}},
    {"crossings", {"crossings.X"}},
    {"order", {"order.X"}},
    {"position", {"P.X", "P.Y", "P.Z"}}};

TEST(Layers, TellOfEachPixelWhatTraceTellsOfItsFirstSample) {
  const SceneFolder folder;
  folder.write("scene.toml", layered_scene);
  ASSERT_EQ(run_portalens(folder.path(),
                          {"render", "scene.toml", "-o", "a.exr", "--layers", every_layer_word})
                .code,
            0);
  Faults faults;
  const auto picture = read_channels(folder.path() / "a.exr", Location{}, faults);
  ASSERT_TRUE(picture);
  std::map<std::string, const std::vector<float>*> channels;
  for (const Channel& channel : picture->channels) channels[channel.name] = &channel.values;

  test::Random random(7);
  std::vector<std::string> words = {"trace", "scene.toml", "--json", "--sample", "0"};
  std::vector<std::size_t> pixels;
  // Enough at every scale to meet each of the three fates.
  const int count = std::max(300, test::scaled(1000));
  for (int i = 0; i < count; ++i) {
    const int x = static_cast<int>(random.uniform(0, 40)),
              y = static_cast<int>(random.uniform(0, 30));
    pixels.push_back(static_cast<std::size_t>(y * 40 + x));
    words.insert(words.end(), {"--pixel", std::to_string(x), std::to_string(y)});
  }
  const Outcome outcome = run_portalens(folder.path(), words);
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  std::istringstream lines(outcome.output);
  std::string line;
  std::map<std::string, int> fates;
  for (const std::size_t pixel : pixels) {
    ASSERT_TRUE(std::getline(lines, line));
    const json told = json::parse(line);
    ++fates[told["fate"]];
    for (const auto& [layer, names] : channels_of_layer)
      for (std::size_t c = 0; c < names.size(); ++c) {
        const json& value = names.size() == 1 ? told["layers"][layer] : told["layers"][layer][c];
        ASSERT_EQ(channels.at(names[c])->at(pixel), value.get<float>()) << names[c] << line;
      }
    // This scene has no mirrors: what ends is what the layers show.
    ASSERT_EQ(channels.at("turning.X")->at(pixel), told["turning"].get<float>());
    ASSERT_EQ(channels.at("steps.X")->at(pixel), told["steps"].get<float>());
    ASSERT_EQ(channels.at("crossings.X")->at(pixel), told["crossings"].size());
    ASSERT_EQ(channels.at("P.Y")->at(pixel), told["position"][1].get<float>());
    if (told["fate"] == "hit" || told["fate"] == "absorbed") {
      ASSERT_EQ(channels.at("depth.Z")->at(pixel), told["length"].get<float>());
    }
  }
  EXPECT_GT(fates["hit"], 0);
  EXPECT_GT(fates["escaped"], 0);
  EXPECT_GT(fates["absorbed"], 0);
}

TEST(Layers, AreListedByExrheaderUnderTheNamesThatCompositingProgramsExpect) {
  const SceneFolder folder;
  folder.write("scene.toml", layered_scene);
  ASSERT_EQ(run_portalens(folder.path(),
                          {"render", "scene.toml", "-o", "a.exr", "--layers", every_layer_word})
                .code,
            0);
  const Outcome header = run_shell(folder.path(), "exrheader a.exr");
  ASSERT_EQ(header.code, 0) << header.errors;
  for (const char* name : {"R", "G", "B"})
    EXPECT_NE(header.output.find("\n    " + std::string(name) + ", 32-bit"), std::string::npos);
  for (const auto& [layer, names] : channels_of_layer)
    for (const std::string& name : names)
      EXPECT_NE(header.output.find("\n    " + name + ", 32-bit floating-point"), std::string::npos)
          << name << header.output;
  for (const char* object : {"1 floor\n", "2 ball\n", "3 in\n", "4 out\n", "5 hole\n"})
    EXPECT_NE(header.output.find(object), std::string::npos) << object;
}

TEST(Picture, TellsFromWhereItIsSeenAndWhatLiesBehind) {
  const SceneFolder folder;
  folder.write("scene.toml",
               "camera = { position = [1, 2, 3], look_at = [1, 2, 0], fov = 33 }\n"
               "environment = { color = [0.25, 0.5, 0.75] }\nfilm = { width = 8, height = 4 }\n"
               "shading = { lost_color = [0, 0.125, 1] }\n");
  ASSERT_EQ(run_portalens(folder.path(), {"render", "scene.toml", "-o", "a.exr"}).code, 0);
  const Outcome header = run_shell(folder.path(), "exrheader a.exr");
  for (const auto& [name, value] : {std::pair{"camera ", "perspective"},
                                    {"camera_position", "1 2 3"},
                                    {"camera_forward", "0 0 -1"},
                                    {"camera_up", "0 1 0"},
                                    {"camera_fov", "33 degrees along y"},
                                    {"environment", "0.25 0.5 0.75"},
                                    {"lost_color", "0 0.125 1"}}) {
    const std::size_t at = header.output.find("portalens:" + std::string(name));
    ASSERT_NE(at, std::string::npos) << name << header.output;
    const std::string line = header.output.substr(at, header.output.find('\n', at) - at);
    EXPECT_NE(line.find(value), std::string::npos) << line;
  }
}

TEST(Layers, DependOnNeitherThreadsNorCropAndLeaveThePictureAsItWas) {
  const SceneFolder folder;
  folder.write("scene.toml", layered_scene);
  const auto render = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"render", "scene.toml"};
    words.insert(words.end(), more.begin(), more.end());
    ASSERT_EQ(run_portalens(folder.path(), words).code, 0);
  };
  render({"-o", "one.exr", "--layers", "turning,depth", "-t", "1"});
  render({"-o", "three.exr", "--layers", "depth,turning,depth", "-t", "3"});
  render({"-o", "part.exr", "--layers", "turning", "--crop", "3", "5", "20", "16"});
  render({"-o", "bare.exr"});
  EXPECT_EQ(folder.read("one.exr"), folder.read("three.exr"));
  Faults faults;
  const auto channel = [&](const char* file, const std::string& name) {
    auto picture = read_channels(folder.path() / file, Location{}, faults);
    for (Channel& one : picture->channels)
      if (one.name == name) return std::move(one.values);
    return std::vector<float>{};
  };
  EXPECT_EQ(channel("one.exr", "G"), channel("bare.exr", "G"));
  const auto whole = channel("one.exr", "turning.X"), part = channel("part.exr", "turning.X");
  ASSERT_EQ(part.size(), 17u * 11u);
  for (int y = 0; y < 11; ++y)
    for (int x = 0; x < 17; ++x)
      ASSERT_EQ(part.at(static_cast<std::size_t>(y * 17 + x)),
                whole.at(static_cast<std::size_t>((y + 5) * 40 + x + 3)));
}

TEST(Layers, NeedAFileThatHoldsThem) {
  const SceneFolder folder;
  folder.write("scene.toml", layered_scene);
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--layers", "depth", "-o", "a.png"},
        {"--layers", "depth", "-o", "a.jpg"},
        {"--layers", "death", "-o", "a.exr"}}) {
    std::vector<std::string> words = {"render", "scene.toml"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run_portalens(folder.path(), words);
    EXPECT_EQ(outcome.code, 2) << quoted(words);
    EXPECT_FALSE(outcome.errors.empty());
  }
  EXPECT_EQ(folder.size(), 1u);
}

TEST(Statistics, NameTheFirstLostPixelsReadyToBePasted) {
  const SceneFolder folder;
  folder.write("scene.toml", layered_scene);
  const Outcome rendered =
      run_portalens(folder.path(), {"render", "scene.toml", "--set", "physics.max_length=7",
                                    "--stats", "--width", "32", "--tile", "3"});
  ASSERT_EQ(rendered.code, 0) << rendered.errors;
  std::istringstream lines(rendered.output);
  int pasted = 0;
  std::string first;
  for (std::string line; std::getline(lines, line);) {
    const auto begin = line.find("portalens trace");
    if (begin == std::string::npos) continue;
    if (first.empty()) first = line;
    const Outcome traced =
        run_shell(folder.path(), quoted({PORTALENS_PROGRAM}) +
                                     line.substr(begin + std::string("portalens").size()));
    EXPECT_EQ(traced.code, 0) << line << traced.errors;
    EXPECT_NE(traced.output.find("lost"), std::string::npos) << line << traced.output;
    ++pasted;
  }
  EXPECT_EQ(pasted, 8) << rendered.output;
  EXPECT_NE(first.find("--pixel 0 0 --sample 0"), std::string::npos) << first;
  for (const char* part : {"field and surfaces", "shading", "shadow rays", "steps a photon"})
    EXPECT_NE(rendered.output.find(part), std::string::npos) << part;
}

}  // namespace
}  // namespace portalens
