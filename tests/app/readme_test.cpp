/// \file
/// What the README tells a newcomer to do works as it is written.
#include <gtest/gtest.h>

#include <regex>

#include "support/run_program.h"

namespace portalens {
namespace {

std::string readme() {
  std::ostringstream text;
  text << std::ifstream(PORTALENS_SOURCE_DIR "/README.md").rdbuf();
  return text.str();
}

TEST(Readme, ItsFirstSceneAndItsCommandsWork) {
  const std::string text = readme();
  const std::string opening = "```toml\n";
  const std::size_t begin = text.find(opening);
  ASSERT_NE(begin, std::string::npos);
  const std::size_t from = begin + opening.size();
  const SceneFolder folder;
  folder.write("first.toml", text.substr(from, text.find("```", from) - from));

  const std::regex command("\n    build/portalens ((?:check|render|trace) first[^\n#]*)");
  int commands = 0;
  for (std::sregex_iterator i(text.begin(), text.end(), command), end; i != end; ++i, ++commands) {
    std::string line = (*i)[1];
    if (line.starts_with("render")) line += " --width 40 --height 24";
    const Outcome outcome = run_shell(folder.path(), quoted({PORTALENS_PROGRAM}) + " " + line);
    EXPECT_EQ(outcome.code, 0) << line << '\n' << outcome.errors;
    EXPECT_NE(outcome.output, "") << line;
  }
  EXPECT_EQ(commands, 4);
  EXPECT_EQ(folder.size(), 3u) << "the scene, first.png and first.exr";
}

TEST(Readme, EveryFileThatItNamesIsThere) {
  const std::string text = readme();
  const std::regex link("\\]\\(([^)#:]+)\\)");
  int links = 0;
  for (std::sregex_iterator i(text.begin(), text.end(), link), end; i != end; ++i, ++links)
    EXPECT_TRUE(
        std::filesystem::exists(std::filesystem::path(PORTALENS_SOURCE_DIR) / (*i)[1].str()))
        << (*i)[1];
  EXPECT_GT(links, 5);
}

}  // namespace
}  // namespace portalens
