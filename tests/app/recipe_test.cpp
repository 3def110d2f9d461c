/// \file
/// `--from`: a picture made again from what its own file says.
#include <gtest/gtest.h>

#include "io/exr_texts.h"
#include "io/image.h"
#include "support/run_program.h"
#include "support/tiny_scene.h"

namespace portalens {
namespace {

/// The tiny scene under a sky that is a file.
std::string under_a_sky() {
  std::string scene = tiny;
  const std::string color = "color = [0.25, 0.5, 0.75]";
  return scene.replace(scene.find(color), color.size(), "image = \"sky.exr\"");
}

void write_sky(const SceneFolder& folder, float red) {
  const std::vector<Channel> sky = {{"R", {red, 0.5f}}, {"G", {0.5f, 0.5f}}, {"B", {1.0f, 0.5f}}};
  write_image(folder.path() / "sky.exr", 2, 1, sky, {});
}

void expect_refused(const SceneFolder& folder, const std::vector<std::string>& words,
                    const std::string& why) {
  const Outcome outcome = run_portalens(folder.path(), words);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.errors.find(why), std::string::npos) << outcome.errors;
}

TEST(Recipe, MakesTheSamePictureOfThePictureAlone) {
  const SceneFolder folder;
  const std::vector<std::vector<std::string>> manners = {
      {},
      {"--width", "12"},
      {"--set", "sphere.ball.radius=0.5", "--layers", "depth"},
      {"--crop", "1", "2", "7", "5", "--engine", "scalar"},
      {"--photons", "all", "--exposure", "-2"}};
  for (const std::vector<std::string>& manner : manners) {
    folder.write("tiny.toml", tiny);
    std::vector<std::string> words = {"render", "tiny.toml", "-o", "a.exr"};
    words.insert(words.end(), manner.begin(), manner.end());
    expect_done(folder, words);
    std::filesystem::remove(folder.path() / "tiny.toml");
    expect_done(folder, {"render", "--from", "a.exr"});
    EXPECT_EQ(folder.read("a-again.exr"), folder.read("a.exr")) << "header and all";
    if (manner.size() <= 5) continue;
    for (const auto& [name, text] : read_exr_texts(folder.path() / "a-again.exr"))
      if (name == "portalens:engine") {
        EXPECT_EQ(text, "scalar");
      }
  }
}

TEST(Recipe, MergedPartsKeepIt) {
  const SceneFolder folder;
  folder.write("tiny.toml", tiny);
  expect_done(folder, {"render", "tiny.toml", "-o", "whole.exr"});
  expect_done(folder, {"render", "tiny.toml", "-o", "a.part", "--samples-to", "1"});
  expect_done(folder, {"render", "tiny.toml", "-o", "b.part", "--samples-from", "1"});
  expect_done(folder, {"merge", "a.part", "b.part", "-o", "merged.exr"});
  expect_done(folder, {"render", "--from", "merged.exr", "-o", "again.exr"});
  EXPECT_EQ(folder.read("again.exr"), folder.read("whole.exr"));
}

TEST(Recipe, WhatTheCommandLineSaysComesAfterIt) {
  const SceneFolder folder;
  folder.write("tiny.toml", tiny);
  expect_done(folder, {"render", "tiny.toml", "-o", "a.exr", "--width", "12", "--crop", "0", "0",
                       "3", "3"});
  expect_done(folder, {"render", "tiny.toml", "-o", "wide.exr", "--width", "20"});
  expect_done(folder, {"render", "--from", "a.exr", "-o", "b.exr", "--width", "20"});
  Faults faults;
  const auto wide = read_image(folder.path() / "wide.exr", {}, faults);
  const auto again = read_image(folder.path() / "b.exr", {}, faults);
  ASSERT_TRUE(wide && again);
  EXPECT_EQ(again->pixels, wide->pixels) << "a part of a smaller picture is no part of this one";
  const Outcome told = run_portalens(folder.path(), {"check", "--from", "a.exr"});
  EXPECT_NE(told.output.find("12 x 9"), std::string::npos) << told.output << told.errors;
}

TEST(Recipe, NamesTheFilesThatAreMissingOrChanged) {
  const SceneFolder folder;
  folder.write("tiny.toml", under_a_sky());
  write_sky(folder, 0.25f);
  expect_done(folder, {"render", "tiny.toml", "-o", "a.exr"});
  std::filesystem::create_directory(folder.path() / "away");
  std::filesystem::rename(folder.path() / "sky.exr", folder.path() / "away" / "sky.exr");
  expect_refused(folder, {"render", "--from", "a.exr"}, "its file 'sky.exr' is not in this folder");
  expect_done(folder, {"render", "--from", "a.exr", "--scene-folder", "away"});
  EXPECT_EQ(folder.read("a-again.exr"), folder.read("a.exr"));
  write_sky(folder, 0.75f);
  expect_refused(folder, {"render", "--from", "a.exr"},
                 "a.exr: the file 'sky.exr' is not the one it was made with");
  expect_done(folder, {"render", "--from", "a.exr", "--changed-files"});
  EXPECT_NE(folder.read("a-again.exr"), folder.read("a.exr"));
}

/// The picture with its recipe put in place of what stood there.
void write_with_recipe(const SceneFolder& folder, const std::string& recipe) {
  const std::vector<Channel> gray = {{"R", {0.5f}}, {"G", {0.5f}}, {"B", {0.5f}}};
  write_image(folder.path() / "odd.exr", 1, 1, gray, {{"portalens:recipe", recipe}});
}

TEST(Recipe, TrustsNothingThatAFileSays) {
  const SceneFolder folder;
  folder.write("tiny.toml", tiny);
  expect_done(folder, {"render", "tiny.toml", "-o", "a.exr"});
  expect_done(folder, {"render", "tiny.toml", "-o", "a.png"});
  expect_refused(folder, {"render", "--from", "a.png"}, "the picture a.png is no EXR");
  expect_refused(folder, {"render", "--from", "absent.exr"}, "there is no file absent.exr");
  expect_refused(folder, {"render", "--from", "a.exr", "tiny.toml"},
                 "both a scene and --from are given");
  expect_refused(folder, {"render", "tiny.toml", "--scene-folder", "."}, "are for --from");
  std::string recipe;
  for (const auto& [name, text] : read_exr_texts(folder.path() / "a.exr"))
    if (name == "portalens:recipe") recipe = text;
  ASSERT_NE(recipe, "");
  write_with_recipe(folder, recipe);
  expect_done(folder, {"render", "--from", "odd.exr"});
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string other = recipe;
    return other.replace(other.find(from), from.size(), to);
  };
  const std::string damaged = "what the picture odd.exr tells of its making is damaged";
  for (const std::string& odd :
       {std::string("{"), std::string("[]"), std::string(100000, '['),
        recipe.substr(0, recipe.size() / 2), changed("\"text\":\"78", "\"text\":\"79"),
        changed("\"digest\":\"", "\"digest\":\"0"), changed("\"layers\":[", "\"layers\":[\"no\""),
        changed("\"set\":[", "\"set\":[1"), changed("automatic", "fast"),
        changed("\"name\":\"tiny.toml\"", "\"name\":\"..\""),
        changed("tiny.toml", "tiny\\u001b.toml"), changed("tiny.toml", "tiny\\u0000.toml"),
        changed("\"files\":[", "\"files\":[{\"name\":3}")}) {
    write_with_recipe(folder, odd);
    expect_refused(folder, {"render", "--from", "odd.exr"}, damaged);
  }
  write_with_recipe(folder,
                    changed("\"files\":[", "\"files\":[{\"name\":\"../x\",\"digest\":\"\"}"));
  expect_refused(folder, {"render", "--from", "odd.exr"}, "leaves the folder");
  write_with_recipe(folder, changed("\"name\":\"tiny.toml\"", "\"name\":\"../../tiny.toml\""));
  expect_done(folder, {"render", "--from", "odd.exr"});
  write_with_recipe(folder, changed("\"program\":\"", "\"program\":\"0.0."));
  const Outcome older = run_portalens(folder.path(), {"render", "--from", "odd.exr"});
  EXPECT_EQ(older.code, 0);
  EXPECT_NE(older.errors.find("was made by portalens 0.0."), std::string::npos) << older.errors;
}

TEST(Recipe, AWindowOfAStrangersIsTakenOnlyWhereItIsPartOfThePicture) {
  const SceneFolder folder;
  folder.write("tiny.toml", tiny);
  expect_done(folder, {"render", "tiny.toml", "-o", "a.exr"});
  Metadata header = read_exr_texts(folder.path() / "a.exr");
  const std::vector<Channel> gray = {{"R", {0.5f}}, {"G", {0.5f}}, {"B", {0.5f}}};
  for (const char* window : {"5 5 5 5", "7 5 3 2", "0 0 -2147483648 2", "-1 -1 3 3",
                             "0 0 9999 9999", "0 0 99999999999999999999 3", "", "one"}) {
    for (auto& [name, text] : header)
      if (name == "portalens:window") text = window;
    write_image(folder.path() / "odd.exr", 1, 1, gray, header);
    expect_done(folder, {"render", "--from", "odd.exr"});
    EXPECT_EQ(folder.read("odd-again.exr"), folder.read("a.exr")) << window;
  }
}

TEST(Recipe, OfAPictureWithLayersAPictureToLookAtIsMade) {
  const SceneFolder folder;
  folder.write("tiny.toml", tiny);
  expect_done(folder, {"render", "tiny.toml"});
  expect_done(folder, {"render", "tiny.toml", "--layers", "all"});
  expect_done(folder, {"render", "--from", "tiny.exr", "-o", "look.png"});
  EXPECT_EQ(folder.read("look.png"), folder.read("tiny.png"));
}

TEST(Recipe, AHeaderThatIsCutOffAnywhereIsRefused) {
  const SceneFolder folder;
  folder.write("tiny.toml", tiny);
  expect_done(folder, {"render", "tiny.toml", "-o", "a.exr"});
  const std::string bytes = folder.read("a.exr");
  const std::size_t header = bytes.find("portalens:recipe");
  ASSERT_NE(header, std::string::npos);
  for (std::size_t size = 0; size < header; size += 7) {
    folder.write("cut.exr", bytes.substr(0, size));
    EXPECT_THROW((void)read_exr_texts(folder.path() / "cut.exr"), SceneError) << size;
  }
}

}  // namespace
}  // namespace portalens
