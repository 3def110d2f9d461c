/// \file
/// What the pages of docs/ tell a reader to type works as it is written.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include "support/pictures.h"
#include "support/run_program.h"

namespace portalens {
namespace {

namespace fs = std::filesystem;

const fs::path root = PORTALENS_SOURCE_DIR;

std::string page(const std::string& name) {
  std::ostringstream text;
  text << std::ifstream(root / "docs" / name).rdbuf();
  return text.str();
}

/// What pages call scene.toml: wide, since a crop of them is.
const std::string any_scene =
    "film = { width = 1920, height = 540 }\nsampler = { samples = 1 }\n"
    "[[sphere]]\nname = \"ball\"\ncenter = [0, 0, 0]\nradius = 1\n"
    "[[light]]\nposition = [3, 4, 5]\nintensity = [50, 50, 50]\n";

/// The commands of a page, and the words that it abbreviates; those that go on from an interrupted
/// render, and those that make the pictures of the gallery (tests/scenes has them), are left out.
std::vector<std::string> commands_of(const std::string& text) {
  const std::regex line("\n    ((?:portalens |[a-z]+=\")[^\n]*)");
  std::vector<std::string> commands;
  for (std::sregex_iterator i(text.begin(), text.end(), line), end; i != end; ++i) {
    const std::string command = (*i)[1];
    if (command.find("docs/gallery") != std::string::npos ||
        command.find("--resume") != std::string::npos)
      continue;
    commands.push_back(command);
  }
  return commands;
}

/// A folder in which they may be typed.
void furnish(const SceneFolder& folder) {
  fs::create_directory(folder.path() / "bin");
  fs::create_symlink(PORTALENS_PROGRAM, folder.path() / "bin" / "portalens");
  fs::create_symlink(root / "scenes", folder.path() / "scenes");
  folder.write("scene.toml", any_scene);
}

struct Page : testing::TestWithParam<const char*> {};

TEST_P(Page, ItsCommandsWork) {
  const SceneFolder folder;
  furnish(folder);
  std::string before = "export PATH=\"$PWD/bin:$PATH\"; ";
  int run = 0;
  for (std::string command : commands_of(page(GetParam()))) {
    if (!command.starts_with("portalens")) {
      before += command + "; ";
      continue;
    }
    // A thousand samples of a pixel show no more than a few.
    command = std::regex_replace(command, std::regex("--samples 1024"), "--samples 2");
    const std::size_t note = command.find("  #");
    const Outcome outcome = run_shell(folder.path(), before + command.substr(0, note));
    EXPECT_EQ(outcome.code, 0) << command << '\n' << outcome.errors;
    ++run;
  }
  EXPECT_GT(run, 0);
}

/// The blocks of a page that are loops, without their indentation.
std::vector<std::string> loops_of(const std::string& text) {
  std::vector<std::string> loops;
  std::string block;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("    ")) {
      block += line.substr(4) + '\n';
      continue;
    }
    if (!block.empty()) block.pop_back();  // the end of its last line
    if (block.find("for i in") != std::string::npos) loops.push_back(block);
    block.clear();
  }
  return loops;
}

TEST(Films, TheirLoopsTakeEveryPicture) {
  const SceneFolder folder;
  furnish(folder);
  for (std::string loop : loops_of(page("films.md"))) {
    loop =
        std::regex_replace(loop, std::regex("--width 320 --samples 4"), "--width 16 --samples 1");
    const Outcome outcome =
        run_shell(folder.path(), "export PATH=\"$PWD/bin:$PATH\"; set -e\n" + loop);
    EXPECT_EQ(outcome.code, 0) << loop << outcome.errors;
  }
  for (const char* name :
       {"walk-000", "walk-024", "door-000", "door-033", "door-034", "door-042"}) {
    const Image image = picture_in(folder, std::string("frames/") + name + ".png");
    ASSERT_FALSE(image.pixels.empty()) << name;
    // From within a wall, or behind all of them, one would see a single colour.
    const auto [least, most] = std::minmax_element(image.pixels.begin(), image.pixels.end());
    EXPECT_GT(*most - *least, 0.1f) << name;
  }
}

/// One blank in place of many, and 0 in place of what rounding leaves of it.
std::string plain(const std::string& text) {
  return std::regex_replace(std::regex_replace(text, std::regex("\\s+"), " "),
                            std::regex("-?[0-9.]+e-1[0-9]"), "0");
}

TEST(SeeWhy, PrintsWhatTraceSays) {
  const SceneFolder folder;
  furnish(folder);
  const std::string text = page("see-why.md"), printed = plain(text);
  std::string before = "export PATH=\"$PWD/bin:$PATH\"; ";
  int lines = 0;
  for (const std::string& command : commands_of(text)) {
    if (!command.starts_with("portalens")) before += command + "; ";
    if (!command.starts_with("portalens trace") || command.find(" -o ") != std::string::npos)
      continue;
    std::istringstream told(run_shell(folder.path(), before + command).output);
    for (std::string line; std::getline(told, line);)
      if (line.find("steps;") != std::string::npos) {
        const std::string until_steps = line.substr(0, line.find("steps;"));
        EXPECT_NE(printed.find(plain(until_steps)), std::string::npos) << line;
        ++lines;
      }
  }
  EXPECT_EQ(lines, 4);
}

INSTANTIATE_TEST_SUITE_P(Of, Page,
                         testing::Values("checkpoints.md", "drawing.md", "films.md",
                                         "scene-files.md", "see-why.md"),
                         [](const auto& tested) {
                           const std::string name = tested.param;
                           return std::regex_replace(name, std::regex("[^a-z]"), "_");
                         });

TEST(SceneFormat, ItsFirstBlockIsAScene) {
  const std::string text = page("scene-format.md"), opening = "```toml\n";
  const std::size_t from = text.find(opening) + opening.size();
  const SceneFolder folder;
  folder.write("pasted.toml", text.substr(from, text.find("```", from) - from));
  const Outcome checked = run_portalens(folder.path(), {"check", "pasted.toml"});
  EXPECT_EQ(checked.code, 0) << checked.errors;
  EXPECT_EQ(checked.output.find("warning"), std::string::npos) << checked.output;
  EXPECT_EQ(run_portalens(folder.path(), {"render", "pasted.toml", "--width", "48"}).code, 0);
}

}  // namespace
}  // namespace portalens
