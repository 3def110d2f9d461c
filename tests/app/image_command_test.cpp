/// \file
/// `portalens image`: layers in colours, and comparisons.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/false_color.h"
#include "app/layer_picture.h"
#include "app/report.h"
#include "io/exr_texts.h"
#include "io/image.h"
#include "support/pictures.h"
#include "support/run_program.h"
#include "support/tiny_scene.h"

namespace portalens {
namespace {

using nlohmann::json;

/// A picture whose red grows from pixel to pixel.
void write_ramp(const SceneFolder& folder, const std::string& name, float start, float step) {
  std::vector<Channel> channels = {
      {"R", {}}, {"G", {}}, {"B", {}}, {"fate.X", {}}, {"depth.Z", {}}};
  for (int i = 0; i < 200; ++i) {
    channels[0].values.push_back(start + step * static_cast<float>(i));
    channels[1].values.push_back(0.5f);
    channels[2].values.push_back(0.25f);
    channels[3].values.push_back(static_cast<float>(i % 5));
    channels[4].values.push_back(i == 7 ? 1e10f : static_cast<float>(i));
  }
  write_image(folder.path() / name, 20, 10, channels, {});
}

TEST(Compare, TellsMeanMaximumAndPercentile) {
  const SceneFolder folder;
  write_ramp(folder, "a.exr", 0.0f, 0.0f);
  write_ramp(folder, "b.exr", 0.0f, 1.0f / 256.0f);
  const Outcome outcome =
      run_portalens(folder.path(), {"image", "--compare", "a.exr", "b.exr", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  const json told = json::parse(outcome.output);
  EXPECT_NEAR(told["mean"].get<double>(), 99.5 / 256, 1e-9);
  EXPECT_NEAR(told["max"].get<double>(), 199.0 / 256, 1e-9);
  EXPECT_NEAR(told["p99"].get<double>(), 197.0 / 256, 1e-9) << "198 of 200 do not exceed it";
  EXPECT_EQ(told["max_at"], json({19, 9}));
}

TEST(Compare, ExitsWith1AboveTheThreshold) {
  const SceneFolder folder;
  write_ramp(folder, "a.exr", 0.0f, 0.0f);
  write_ramp(folder, "b.exr", 0.0f, 1.0f / 256.0f);
  const auto code = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"image", "--compare", "a.exr", "b.exr"};
    words.insert(words.end(), more.begin(), more.end());
    return run_portalens(folder.path(), words).code;
  };
  EXPECT_EQ(code({"--threshold", "0.78"}), 0);
  EXPECT_EQ(code({"--threshold", "0.77"}), 1);
  EXPECT_EQ(code({"--threshold", "0.39", "--measure", "mean"}), 0);
  EXPECT_EQ(code({"--threshold", "0.38", "--measure", "mean"}), 1);
  EXPECT_EQ(code({"--threshold", "0.7", "--measure", "p99", "-o", "d.png"}), 1);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "d.png")) << "the differences, all the same";
  EXPECT_EQ(
      run_portalens(folder.path(), {"image", "--compare", "a.exr", "a.exr", "--threshold", "0"})
          .code,
      0);
}

TEST(Develop, WritesAPictureAsAnotherKind) {
  const SceneFolder folder;
  write_ramp(folder, "a.exr", 0.0f, 1.0f / 256.0f);
  for (const char* name : {"a.png", "a.jpg", "A.JPEG"}) {
    const Outcome outcome = run_portalens(folder.path(), {"image", "a.exr", "-o", name});
    ASSERT_EQ(outcome.code, 0) << outcome.errors;
    const Image image = picture_in(folder, name);
    EXPECT_NEAR(image.at(10, 5)[0], 110.0 / 256, name[2] == 'p' ? 0.005 : 0.03) << name;
    EXPECT_NEAR(image.at(10, 5)[2], 0.25, 0.03) << name;
  }
  EXPECT_EQ(folder.read("a.png").substr(1, 3), "PNG");
  EXPECT_EQ(folder.read("a.jpg").substr(0, 2), "\xff\xd8");
}

TEST(ShowLayer, OfAPictureWithoutLayersTellsItsChannels) {
  const SceneFolder folder;
  write_ramp(folder, "a.exr", 0.0f, 1.0f / 256.0f);
  ASSERT_EQ(run_portalens(folder.path(), {"image", "a.exr", "-o", "a.png"}).code, 0);
  const Outcome outcome =
      run_portalens(folder.path(), {"image", "a.png", "--layer", "depth", "-o", "b.png"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.errors.find("its channels are R, G, B; layers are in an .exr"),
            std::string::npos)
      << outcome.errors;
  EXPECT_EQ(run_portalens(folder.path(), {"image", "a.png", "--layer", "G", "-o", "b.png"}).code,
            0);
}

TEST(Develop, ChangesExposureToneAndWhite) {
  const SceneFolder folder;
  write_ramp(folder, "a.exr", 0.0f, 1.0f / 256.0f);
  const auto blue = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"image", "a.exr", "-o", "b.exr"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run_portalens(folder.path(), words);
    EXPECT_EQ(outcome.code, 0) << outcome.errors;
    return picture_in(folder, "b.exr").at(3, 0)[2];
  };
  EXPECT_EQ(blue({}), 0.25f);
  EXPECT_EQ(blue({"--exposure", "1"}), 0.5f);
  EXPECT_NEAR(blue({"--tone", "filmic"}), 0.25 * 0.6575 / (0.25 * 1.1975 + 0.14), 1e-5);
  EXPECT_GT(blue({"--white-balance", "3200"}), 0.3f);
  EXPECT_EQ(run_portalens(folder.path(), {"image", "a.exr", "-o", "b.exr", "--tone", "film"}).code,
            2);
  EXPECT_EQ(run_portalens(folder.path(),
                          {"image", "a.exr", "--layer", "fate", "-o", "b.exr", "--exposure", "1"})
                .code,
            2);
}

TEST(ShowLayer, HasTheColoursOfItsNumbersAndALegend) {
  const SceneFolder folder;
  write_ramp(folder, "a.exr", 0.0f, 1.0f);
  const auto shown = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"image", "a.exr", "-o", "out.exr"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run_portalens(folder.path(), words);
    EXPECT_EQ(outcome.code, 0) << outcome.errors;
    Faults faults;
    return read_image(folder.path() / "out.exr", Location{}, faults).value_or(Image{});
  };
  const auto expect_color = [](const Image& image, int x, int y, Rgb color) {
    EXPECT_NEAR(image.at(x, y)[0], color.x, 1e-6);
    EXPECT_NEAR(image.at(x, y)[1], color.y, 1e-6);
    EXPECT_NEAR(image.at(x, y)[2], color.z, 1e-6);
  };
  const Image depth = shown({"--layer", "depth"});
  expect_color(depth, 0, 0, heat_color(0.0));
  expect_color(depth, 19, 9, heat_color(1.0));
  expect_color(depth, 3, 5, heat_color(103.0 / 199.0));
  expect_color(depth, 7, 0, {0, 0, 0});  // nothing is there
  const Image red = shown({"--layer", "R", "--range", "0", "400"});
  expect_color(red, 0, 5, heat_color(0.25));
  const Image fate = shown({"--layer", "fate"});
  expect_color(fate, 13, 0, number_color(3));
  for (const Image* image : {&depth, &red, &fate}) {
    ASSERT_GT(image->width, 100);
    bool white = false;
    for (int y = 0; y < image->height; ++y)
      for (int x = 20; x < image->width; ++x) white |= image->at(x, y)[1] == 1.0f;
    EXPECT_TRUE(white) << "the legend has numbers";
  }
}

TEST(ShowLayer, LightnessRisesWithTheNumber) {
  double last = -1.0;
  for (int i = 0; i <= 100; ++i) {
    const Rgb color = heat_color(i / 100.0);
    const double lightness = 0.2126 * color.x + 0.7152 * color.y + 0.0722 * color.z;
    EXPECT_GT(lightness, last) << i;
    last = lightness;
  }
}

TEST(ShowLayer, FaultsAreTold) {
  const SceneFolder folder;
  write_ramp(folder, "a.exr", 0.0f, 0.0f);
  write_image(folder.path() / "small.exr", 1, 1, {{"R", {1}}, {"G", {1}}, {"B", {1}}}, {});
  const std::vector<std::vector<std::string>> wrong = {
      {"image"},
      {"image", "a.exr", "-o", "b.bmp"},
      {"image", "a.exr", "--layer", "depth"},
      {"image", "a.exr", "--layer", "death", "-o", "b.png"},
      {"image", "absent.exr", "--layer", "depth", "-o", "b.png"},
      {"image", "--compare", "a.exr"},
      {"image", "--compare", "a.exr", "small.exr"},
      {"image", "--compare", "a.exr", "absent.exr"},
      {"image", "--compare", "a.exr", "a.exr", "--threshold", "-1"},
      {"image", "a.exr", "--layer", "depth", "--compare", "a.exr", "a.exr"}};
  for (const auto& words : wrong) {
    const Outcome outcome = run_portalens(folder.path(), words);
    EXPECT_EQ(outcome.code, 2) << quoted(words) << outcome.errors;
    EXPECT_FALSE(outcome.errors.empty());
  }
  EXPECT_EQ(folder.size(), 2u);
}

TEST(ImageCommand, DevelopsAsTheHeaderOfAnExrAsks) {
  const SceneFolder folder;
  folder.write("tiny.toml", tiny);
  const std::vector<std::string> manner = {"--exposure", "-2", "--tone", "filmic"};
  std::vector<std::string> light = {"render", "tiny.toml", "-o", "dark.exr"}, shown = light;
  shown[3] = "shown.png";
  for (auto* words : {&light, &shown}) {
    words->insert(words->end(), manner.begin(), manner.end());
    expect_done(folder, *words);
  }
  expect_done(folder, {"image", "dark.exr", "-o", "same.png"});
  EXPECT_EQ(folder.read("same.png"), folder.read("shown.png"));
  expect_done(folder,
              {"image", "dark.exr", "-o", "linear.png", "--exposure", "0", "--tone", "linear"});
  expect_done(folder, {"render", "tiny.toml", "-o", "plain.png"});
  EXPECT_EQ(folder.read("linear.png"), folder.read("plain.png"));
}

TEST(ImageCommand, FromExrToExrKeepsLayersAndHeader) {
  const SceneFolder folder;
  folder.write("tiny.toml", tiny);
  expect_done(folder, {"render", "tiny.toml", "--layers", "all", "--exposure", "-2"});
  expect_done(folder, {"image", "tiny.exr", "-o", "copy.exr"});
  EXPECT_EQ(folder.read("copy.exr"), folder.read("tiny.exr"));
  expect_done(folder, {"image", "tiny.exr", "-o", "bright.exr", "--exposure", "1"});
  Faults faults;
  const auto before = read_channels(folder.path() / "tiny.exr", {}, faults);
  const auto after = read_channels(folder.path() / "bright.exr", {}, faults);
  ASSERT_TRUE(before && after);
  ASSERT_EQ(after->channels.size(), before->channels.size());
  for (std::size_t c = 0; c < after->channels.size(); ++c) {
    const bool color = std::string("RGB").find(after->channels[c].name) != std::string::npos;
    std::vector<float> expected = before->channels[c].values;
    for (float& value : expected) value *= color ? 2.0f : 1.0f;
    EXPECT_EQ(after->channels[c].values, expected) << after->channels[c].name;
  }
  for (const auto& [name, text] : read_exr_texts(folder.path() / "bright.exr"))
    if (name == "portalens:exposure") {
      EXPECT_EQ(text, "0") << "it would be asked for twice";
    }
}

TEST(ImageCommand, TheLegendOfObjectsHasTheirNames) {
  std::map<int, std::string> names =
      listed_names("1 ball\n2 the wall\nnonsense\n3\n99999999999 far\n");
  EXPECT_EQ(names, (std::map<int, std::string>{{1, "ball"}, {2, "the wall"}}));
  const ChannelPicture picture{4, 64, {{"object.X", std::vector<float>(256, 2.0f)}}};
  LayerStyle style;
  const Image numbered = layer_picture(picture, "object", style);
  style.objects = names;
  const Image named = layer_picture(picture, "object", style);
  EXPECT_NE(named.pixels, numbered.pixels);
  style.objects[2] = "a name of more letters than stand in a narrow legend";
  EXPECT_GT(layer_picture(picture, "object", style).width, named.width);
}

}  // namespace
}  // namespace portalens
