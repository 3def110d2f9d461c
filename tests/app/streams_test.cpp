/// \file
/// `-`: scenes and pictures by standard input and output.
#include <gtest/gtest.h>

#include "support/run_program.h"
#include "support/tiny_scene.h"

namespace portalens {
namespace {

TEST(Streams, CarryAPictureFromItsSceneToItsFileAndLeaveNothing) {
  const SceneFolder folder, other;
  folder.write("tiny.toml", tiny);
  EXPECT_EQ(run_portalens(folder.path(), {"render", "tiny.toml"}).code, 0);
  const Outcome piped = run_portalens(other.path(), {"render", "-", "-o", "-"}, tiny);
  EXPECT_EQ(piped.code, 0) << piped.errors;
  EXPECT_EQ(piped.output, folder.read("tiny.png"));
  EXPECT_NE(piped.errors.find("8 x 6"), std::string::npos) << "words go elsewhere";
  EXPECT_EQ(other.size(), 0u);
  const Outcome merged =
      run_shell(folder.path(), quoted({PORTALENS_PROGRAM}) + " render tiny.toml -o a.part -q &&" +
                                   quoted({PORTALENS_PROGRAM}) + " merge a.part -o - -q");
  EXPECT_EQ(merged.output, folder.read("tiny.png"));
}

TEST(Streams, EveryCommandTakesASceneFromStandardInput) {
  const SceneFolder folder;
  folder.write("tiny.toml", tiny);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"check"},
        {"trace", "--ray", "0", "0", "5", "0", "0", "-1"},
        {"field", "--at", "0", "0", "3"},
        {"field", "--plane", "xy", "-o", "-", "--width", "64"},
        {"draw", "-o", "-", "--width", "64", "--no-legend"}}) {
    std::vector<std::string> from_file = words, from_input = words;
    from_file.insert(from_file.begin() + 1, "tiny.toml");
    from_input.insert(from_input.begin() + 1, "-");
    const Outcome file = run_portalens(folder.path(), from_file);
    const Outcome input = run_portalens(folder.path(), from_input, tiny);
    EXPECT_EQ(input.code, 0) << input.errors;
    if (words[0] != "check") {  // which tells the scene's name
      EXPECT_EQ(input.output, file.output) << words[0];
    }
    EXPECT_FALSE(input.output.empty());
  }
  const Outcome faulty = run_portalens(folder.path(), {"check", "-"}, "[film]\nwidth = \"wide\"\n");
  EXPECT_EQ(faulty.code, 2);
  EXPECT_EQ(faulty.errors.find("<stdin>:2: "), 0u) << faulty.errors;
  EXPECT_EQ(run_portalens(folder.path(), {"check", "-"}, "").code, 2);
  const Outcome long_one =
      run_portalens(folder.path(), {"check", "-"}, std::string(2 << 20, '#') + "\n");
  EXPECT_NE(long_one.errors.find("standard input is longer; at most 1 MiB are read"),
            std::string::npos)
      << long_one.errors;
}

TEST(Streams, ImageTurnsOnePictureIntoAnother) {
  const SceneFolder folder;
  folder.write("tiny.toml", tiny);
  EXPECT_EQ(
      run_portalens(folder.path(), {"render", "tiny.toml", "-o", "a.exr", "--exposure", "-1"}).code,
      0);
  EXPECT_EQ(run_portalens(folder.path(), {"render", "tiny.toml", "--exposure", "-1"}).code, 0);
  const Outcome piped =
      run_portalens(folder.path(), {"image", "-", "-o", "-"}, folder.read("a.exr"));
  EXPECT_EQ(piped.output, folder.read("tiny.png")) << piped.errors;
}

TEST(Streams, RefuseWhatNeedsAFile) {
  const SceneFolder folder;
  folder.write("tiny.toml", tiny);
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"render", "tiny.toml", "-o", "-", "--checkpoint", "5"}, "has no checkpoint"},
      {{"render", "tiny.toml", "-o", "-", "--resume"}, "has no checkpoint"},
      {{"render", "tiny.toml", "-o", "-", "--layers", "depth"}, "can't hold the layers"},
      {{"trace", "tiny.toml", "--pixel", "1", "1", "-o", "-"}, "name a file with -o"}};
  for (const auto& [words, told] : wrong) {
    const Outcome outcome = run_portalens(folder.path(), words);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.output, "");
    EXPECT_NE(outcome.errors.find(told), std::string::npos) << outcome.errors;
  }
  const Outcome full =
      run_shell(folder.path(), quoted({PORTALENS_PROGRAM}) + " render tiny.toml -o - > /dev/full");
  EXPECT_EQ(full.code, 1);
  EXPECT_NE(full.errors.find("can't write standard output: "), std::string::npos) << full.errors;
}

}  // namespace
}  // namespace portalens
