/// \file
/// Every scene of the gallery is a scene, takes its picture, and is told of as it is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "io/override.h"
#include "io/read_scene.h"
#include "render/render.h"
#include "world/compile.h"

namespace portalens {
namespace {

const std::filesystem::path root = PORTALENS_SOURCE_DIR;

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::vector<std::filesystem::path> scenes() {
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::directory_iterator(root / "scenes"))
    if (entry.path().extension() == ".toml") found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

/// A `portalens render`, `draw` or `field` of the text: its words after that.
using Command = std::vector<std::string>;

/// @param kinds  a regular expression of subcommands
std::vector<Command> commands_in(const std::string& text,
                                 const std::string& kinds = "render|draw|field") {
  const std::regex line("portalens (?:" + kinds + ") (scenes/[^\n]*)");
  std::vector<Command> commands;
  for (std::sregex_iterator i(text.begin(), text.end(), line), end; i != end; ++i) {
    std::istringstream words((*i)[1].str());
    commands.emplace_back(std::istream_iterator<std::string>(words),
                          std::istream_iterator<std::string>());
  }
  return commands;
}

/// The scene of a command with what its --set ask for, to be taken in 48 x 27 pixels.
/// @throws SceneError where the command asks for nonsense
Scene small_scene_of(const Command& command) {
  Scene scene = read_scene(root / command.front());
  Faults faults;
  for (std::size_t i = 1; i + 1 < command.size(); ++i)
    if (command[i] == "--set") override_value(scene, command[i + 1], faults);
  for (const std::string size : {"film.width=48", "film.height=27", "sampler.samples=1"})
    override_value(scene, size, faults);
  faults.raise();
  return scene;
}

std::string picture_of(const Command& command) {
  const auto option = std::find(command.begin(), command.end(), "-o");
  return option == command.end() || option + 1 == command.end() ? "" : *(option + 1);
}

TEST(Gallery, EveryPictureIsMadeOfNumbersAndLosesNoPhoton) {
  int pictures = 0;
  for (const auto& file : scenes()) {
    for (const Command& command : commands_in(text_of(file), "render")) {
      SCOPED_TRACE(picture_of(command));
      const RenderResult result = render(compile(small_scene_of(command)), {});
      ++pictures;
      EXPECT_EQ(result.tally.samples, 48u * 27u);
      EXPECT_EQ(result.tally.not_finite, 0u);
      EXPECT_EQ(result.tally.fates[static_cast<std::size_t>(Fate::lost)], 0u);
      EXPECT_TRUE(std::all_of(result.image.pixels.begin(), result.image.pixels.end(),
                              [](float value) { return std::isfinite(value) && value >= 0.0f; }));
      const auto [darkest, brightest] =
          std::minmax_element(result.image.pixels.begin(), result.image.pixels.end());
      EXPECT_GT(*brightest, *darkest + 0.1f) << "nothing is to be seen";
    }
  }
  EXPECT_GT(pictures, 20);
}

/// In the paper skies are seen, and light nothing.
TEST(Gallery, ThePapersScenesAreLitByLampsAlone) {
  for (const std::filesystem::path& file : scenes()) {
    if (file.filename().string().rfind("figure-", 0) != 0) continue;
    const World world = compile(read_scene(file));
    for (const Light& light : world.appearance.lights)
      EXPECT_FALSE(std::holds_alternative<SkyLight>(light)) << file;
  }
}

TEST(Gallery, EverySceneBeginsWithItsOwnCommand) {
  for (const auto& file : scenes()) {
    const std::string text = text_of(file);
    EXPECT_TRUE(text.starts_with("# ")) << file;
    const std::vector<Command> commands = commands_in(text);
    EXPECT_FALSE(commands.empty()) << file;
    for (const Command& command : commands)
      EXPECT_EQ(root / command.front(), file) << "a command of another scene";
  }
}

TEST(Gallery, ThePageOfThePaperGivesTheScenesOwnCommands) {
  std::set<Command> known;
  for (const auto& file : scenes())
    for (const Command& command : commands_in(text_of(file))) known.insert(command);
  const std::vector<Command> told = commands_in(text_of(root / "docs/paper.md"));
  EXPECT_GT(told.size(), 20u);
  for (const Command& command : told) {
    EXPECT_TRUE(known.contains(command)) << picture_of(command);
    EXPECT_TRUE(std::filesystem::exists(root / picture_of(command))) << picture_of(command);
  }
}

TEST(Gallery, ThePageOfThePaperShowsPicturesThatAreThere) {
  const std::string text = text_of(root / "docs/paper.md");
  const std::regex link("\\]\\(([^)#:]+)\\)");
  int links = 0;
  for (std::sregex_iterator i(text.begin(), text.end(), link), end; i != end; ++i, ++links)
    EXPECT_TRUE(std::filesystem::exists(root / "docs" / (*i)[1].str())) << (*i)[1];
  EXPECT_GT(links, 20);
}

}  // namespace
}  // namespace portalens
