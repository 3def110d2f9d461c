/// \file
/// The program from end to end: what it writes, what it says, and how it exits.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io/image.h"
#include "portalens/version.h"
#include "support/run_program.h"

namespace portalens {
namespace {

using nlohmann::json;

const std::string tiny = R"([camera]
position = [0, 0, 5]
look_at = [0, 0, 0]
[film]
width = 8
height = 6
[sampler]
samples = 2
[environment]
color = [0.25, 0.5, 0.75]
[[sphere]]
name = "ball"
center = [0, 0, 0]
radius = 1
mass = 100
)";

Image picture_in(const SceneFolder& folder, const std::string& name) {
  Faults faults;
  auto image = read_image(folder.path() / name, Location{}, faults);
  EXPECT_TRUE(image) << name;
  return image.value_or(Image{});
}

TEST(Program, TeachesWhatItDoes) {
  const SceneFolder folder;
  const Outcome help = run_portalens(folder.path(), {"--help"});
  EXPECT_EQ(help.code, 0);
  for (const char* word : {"render", "check", "trace", "Examples"})
    EXPECT_NE(help.output.find(word), std::string::npos) << word;
  for (const char* command : {"render", "check", "trace"})
    EXPECT_EQ(run_portalens(folder.path(), {command, "--help"}).code, 0);
  const Outcome version = run_portalens(folder.path(), {"--version"});
  EXPECT_EQ(version.code, 0);
  EXPECT_EQ(version.output, "portalens " + std::string(api::version) + "\n");
}

TEST(Program, AFaultOfTheCommandLineExitsWith2AndSaysWhy) {
  const SceneFolder folder;
  folder.write("tiny.toml", tiny);
  const std::vector<std::vector<std::string>> wrong = {
      {},
      {"paint"},
      {"render"},
      {"render", "tiny.toml", "--sample", "4"},
      {"render", "tiny.toml", "--width", "0"},
      {"render", "tiny.toml", "--width", "many"},
      {"render", "tiny.toml", "-t", "0"},
      {"render", "tiny.toml", "--crop", "1", "2"},
      {"render", "tiny.toml", "--crop", "0", "0", "9", "6"},
      {"render", "tiny.toml", "--crop", "4", "0", "4", "6"},
      {"render", "tiny.toml", "--set", "physics.tolerance"},
      {"render", "tiny.toml", "--set", "physick.tolerance=1"},
      {"render", "tiny.toml", "--set", "physics.tolerence=1e-5"},
      {"render", "absent.toml"},
      {"check", "tiny.toml", "more.toml"},
      {"trace", "tiny.toml"},
      {"trace", "tiny.toml", "--ray", "0", "0", "5", "0", "0", "0"},
      {"trace", "tiny.toml", "--ray", "0", "0", "5", "0", "0"},
      {"trace", "tiny.toml", "--ray", "0", "0", "5", "0", "0", "nan"},
      {"trace", "tiny.toml", "--rays", "absent.txt"},
      {"trace", "tiny.toml", "--rays", "."}};
  for (const auto& arguments : wrong) {
    const Outcome outcome = run_portalens(folder.path(), arguments);
    EXPECT_EQ(outcome.code, 2) << quoted(arguments) << outcome.output << outcome.errors;
    EXPECT_FALSE(outcome.errors.empty()) << quoted(arguments);
    EXPECT_TRUE(outcome.output.empty()) << quoted(arguments) << outcome.output;
  }
  EXPECT_EQ(folder.size(), 1u) << "nothing was written";
}

TEST(Render, WritesThePictureBesideTheUserAndSaysWhere) {
  const SceneFolder folder;
  std::filesystem::create_directory(folder.path() / "scenes");
  folder.write("scenes/tiny.toml", tiny);
  const Outcome outcome = run_portalens(folder.path(), {"render", "scenes/tiny.toml"});
  EXPECT_EQ(outcome.code, 0) << outcome.errors;
  EXPECT_NE(outcome.output.find("tiny.png"), std::string::npos);
  EXPECT_NE(outcome.output.find("hit"), std::string::npos) << "fates are reported";
  const Image image = picture_in(folder, "tiny.png");
  EXPECT_EQ(image.width, 8);
  EXPECT_EQ(image.height, 6);
}

TEST(Render, DrawsNoProgressWhenPiped) {
  const SceneFolder folder;
  folder.write("tiny.toml", tiny);
  const Outcome outcome = run_portalens(folder.path(), {"render", "tiny.toml"});
  EXPECT_EQ(outcome.errors, "");
  EXPECT_EQ(outcome.output.find('\r'), std::string::npos);
}

TEST(Render, QuietPrintsNothing) {
  const SceneFolder folder;
  folder.write("tiny.toml", tiny);
  const Outcome outcome = run_portalens(folder.path(), {"render", "tiny.toml", "--quiet"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.output + outcome.errors, "");
}

TEST(Render, SaysByWhichEngineAndWhyWhereverItTellsOfThePicture) {
  const SceneFolder folder;
  folder.write("tiny.toml", std::string(tiny) + "[[mass]]\ncenter = [0, 0, 0]\nmass = 9\n");
  const std::vector<std::string> infinite = {"--set", "physics.min_force=0"};
  const auto outcome = [&](std::vector<std::string> words) {
    words.insert(words.end(), infinite.begin(), infinite.end());
    return run_portalens(folder.path(), words).output;
  };
  const char* why = "an influence is infinite (physics.min_force = 0";
  for (const std::string& text :
       {outcome({"check", "tiny.toml"}), outcome({"render", "tiny.toml", "--stats"})}) {
    EXPECT_NE(text.find("scalar, because " + std::string(why)), std::string::npos) << text;
    EXPECT_NE(text.find("all, because only lanes"), std::string::npos) << text;
  }
  for (const std::string& text : {outcome({"check", "tiny.toml", "--json"}),
                                  outcome({"render", "tiny.toml", "--json", "-o", "a.exr"})})
    EXPECT_NE(text.find("\"engine\":{\"name\":\"scalar\",\"because\":\"" + std::string(why)),
              std::string::npos)
        << text;
  EXPECT_NE(folder.read("a.exr").find(why), std::string::npos);
  EXPECT_NE(run_portalens(folder.path(), {"check", "tiny.toml"}).output.find("engine      lanes"),
            std::string::npos);
}

TEST(Render, OptionsStandAboveTheFile) {
  const SceneFolder folder;
  folder.write("tiny.toml", tiny);
  const Outcome outcome = run_portalens(
      folder.path(), {"render", "tiny.toml", "--width", "5", "--height", "4", "--samples", "3",
                      "--set", "environment.color=[1.0, 1.0, 1.0]", "--set", "sampler.seed=9", "-o",
                      "big.exr", "--json", "-t", "2", "--tile", "2"});
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  const json told = json::parse(outcome.output);
  EXPECT_EQ(told["width"], 5);
  EXPECT_EQ(told["height"], 4);
  EXPECT_EQ(told["samples"], 5 * 4 * 3);
  EXPECT_EQ(told["picture"], "big.exr");
  EXPECT_EQ(told["complete"], true);
  std::uint64_t sum = 0;
  for (const auto& [fate, count] : told["fates"].items()) sum += count.get<std::uint64_t>();
  EXPECT_EQ(sum, told["photons"]);
  EXPECT_EQ(picture_in(folder, "big.exr").at(0, 0)[0], 1.0f);
}

TEST(Render, APictureKeepsItsShapeWhereOnlyOneSideIsGiven) {
  const SceneFolder folder;
  folder.write("tiny.toml", tiny);  // 8 x 6
  struct Given {
    std::vector<std::string> words;
    int width, height;
  };
  for (const Given& given :
       {Given{{"--width", "16"}, 16, 12}, Given{{"--height", "3"}, 4, 3},
        Given{{"--width", "1"}, 1, 1}, Given{{"--width", "16", "--set", "film.height=5"}, 16, 5},
        Given{{"--set", "film.width=16"}, 16, 6},
        Given{{"--set", "film.width=24", "--height", "2"}, 24, 2}}) {
    std::vector<std::string> words = {"render", "tiny.toml", "--json"};
    words.insert(words.end(), given.words.begin(), given.words.end());
    const Outcome outcome = run_portalens(folder.path(), words);
    ASSERT_EQ(outcome.code, 0) << outcome.errors;
    EXPECT_EQ(json::parse(outcome.output)["width"], given.width) << quoted(words);
    EXPECT_EQ(json::parse(outcome.output)["height"], given.height) << quoted(words);
  }
}

TEST(Render, ACropIsThePartOfTheWholePicture) {
  const SceneFolder folder;
  folder.write("tiny.toml", tiny);
  ASSERT_EQ(run_portalens(folder.path(), {"render", "tiny.toml", "-o", "whole.exr"}).code, 0);
  ASSERT_EQ(run_portalens(folder.path(),
                          {"render", "tiny.toml", "-o", "part.exr", "--crop", "2", "1", "7", "5"})
                .code,
            0);
  const Image whole = picture_in(folder, "whole.exr"), part = picture_in(folder, "part.exr");
  ASSERT_EQ(part.width, 5);
  ASSERT_EQ(part.height, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 5; ++x)
      for (int channel = 0; channel < 3; ++channel)
        ASSERT_EQ(part.at(x, y)[channel], whole.at(x + 2, y + 1)[channel]);
}

TEST(Render, TheSameSceneGivesTheSameFile) {
  const SceneFolder folder;
  folder.write("tiny.toml", tiny);
  for (const char* kind : {".exr", ".png"}) {
    const std::string a = std::string("a") + kind, b = std::string("b") + kind;
    ASSERT_EQ(run_portalens(folder.path(), {"render", "tiny.toml", "-o", a, "-t", "1"}).code, 0);
    ASSERT_EQ(run_portalens(folder.path(), {"render", "tiny.toml", "-o", b, "-t", "3"}).code, 0);
    EXPECT_EQ(folder.read(a), folder.read(b));
  }
}

TEST(Render, FaultsOfTheSceneAreAllToldByLineAndNothingIsWritten) {
  const SceneFolder folder;
  folder.write("bad.toml", R"([camera]
position = [0, 0, 5]
look_at = [0, 0, 0]
fof = 30
[film]
width = -3
[[sphere]]
center = [0, 0, 0]
radius = "big"
material = "nowhere"
)");
  for (const char* command : {"render", "check"}) {
    const Outcome outcome = run_portalens(folder.path(), {command, "bad.toml"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.output, "");
    for (const char* line : {"bad.toml:4: ", "bad.toml:6: ", "bad.toml:9: ", "bad.toml:10: "})
      EXPECT_NE(outcome.errors.find(line), std::string::npos) << line << outcome.errors;
  }
  EXPECT_EQ(folder.size(), 1u);
}

TEST(Render, APlaceThatCantBeWrittenIsToldBeforeTheWork) {
  const SceneFolder folder;
  // Were it rendered first, this would take hours.
  folder.write("long.toml", tiny + "[[sphere]]\ncenter = [3, 0, 0]\nradius = 1\n");
  for (const char* place : {"no/such/folder/a.png", "a.tiff", "/proc/a.png"}) {
    const Outcome outcome =
        run_portalens(folder.path(), {"render", "long.toml", "--width", "30000", "--height",
                                      "30000", "--samples", "1000", "-o", place});
    EXPECT_EQ(outcome.code, place == std::string("a.tiff") ? 2 : 1) << outcome.errors;
    EXPECT_NE(outcome.errors.find(place), std::string::npos) << outcome.errors;
  }
  EXPECT_EQ(folder.size(), 1u);
}

/// Interrupted once it listens (the kernel tells which signals it catches), long before its end.
TEST(Render, AnInterruptLeavesTheOldPictureWholeAndSaysWhatStands) {
  const SceneFolder folder;
  folder.write("tiny.toml", tiny);
  folder.write("out.exr", "old");
  const Outcome outcome = run_shell(
      folder.path(),
      quoted({PORTALENS_PROGRAM}) +
          " render tiny.toml -o out.exr --width 500 --height 500 --samples 100000 --tile 1 & p=$!; "
          "until grep -qE 'SigCgt:.*[4567cdef][0-9a-f]{3}$' /proc/$p/status; do :; done; "
          "kill -TERM $p; wait $p; echo code $?");
  EXPECT_EQ(folder.read("out.exr"), "old");
  EXPECT_NE(outcome.output.find("code 143"), std::string::npos) << outcome.output;
  EXPECT_NE(outcome.errors.find("interrupted"), std::string::npos) << outcome.errors;
  EXPECT_EQ(folder.size(), 4u) << "the checkpoint and the unfinished picture are added";
  EXPECT_EQ(picture_in(folder, "out.unfinished.exr").width, 500);
}

TEST(Program, AWrongWordIsNamedAndTheRightOneToo) {
  const SceneFolder folder;
  folder.write("tiny.toml", tiny);
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{}, "command line: a command is missing; known are "},
      {{"rendr", "tiny.toml"}, "command line: unknown command 'rendr'; did you mean render?"},
      {{"--fast"}, "command line: unknown option '--fast'; try portalens --help"},
      {{"render", "tiny.toml", "--wdith", "30"},
       "command line: unknown option '--wdith'; did you mean --width?"},
      {{"check", "tiny.toml", "b.toml"},
       "command line: nothing is known to do with 'b.toml'; try portalens check --help"},
      {{"render", "tiny.toml", "--width", "-5"}, "'width' is -5; give a whole number from 1 to "},
      {{"render", "tiny.toml", "--width", "wide"}, "--width = wide; try portalens render --help"},
      {{"trace", "tiny.toml"}, "--ray, --rays or --pixel is required; try portalens trace --help"}};
  for (const auto& [words, told] : cases) {
    const Outcome outcome = run_portalens(folder.path(), words);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.errors.find(told), std::string::npos) << outcome.errors;
    EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
  }
}

TEST(Program, HelpFitsATerminal) {
  const SceneFolder folder;
  for (const std::string command : {"", "render", "check", "trace", "image", "field", "draw"}) {
    const Outcome outcome =
        run_shell(folder.path(), quoted({PORTALENS_PROGRAM}) + " " + command + " --help");
    EXPECT_EQ(outcome.code, 0);
    std::istringstream lines(outcome.output);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
  }
}

TEST(Program, AStandardOutputThatFailsIsToldApart) {
  const SceneFolder folder;
  folder.write("tiny.toml", tiny);
  const Outcome outcome =
      run_shell(folder.path(), quoted({PORTALENS_PROGRAM}) + " check tiny.toml >/dev/full");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.errors.find("standard output"), std::string::npos);
}

TEST(Check, TellsMassesAndPortalsWithTheirRadiiAndPairs) {
  const SceneFolder folder;
  folder.write("scene.toml", tiny + R"([[portal]]
name = "a"
pair = "b"
vertices = [[-1, 0, -2], [1, 0, -2], [1, 3, -2], [-1, 3, -2]]
[[portal]]
name = "b"
pair = "a"
vertices = [[4, 0, 0], [6, 0, 0], [6, 3, 0], [4, 3, 0]]
)");
  const Outcome outcome = run_portalens(folder.path(), {"check", "scene.toml", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  const json told = json::parse(outcome.output);
  ASSERT_EQ(told["masses"].size(), 1u);
  const json& mass = told["masses"][0];
  EXPECT_EQ(mass["name"], "ball");
  EXPECT_EQ(mass["mass"], 100.0);
  EXPECT_NEAR(mass["schwarzschild_radius"].get<double>(), 2.0 * 100 / (45.0 * 45.0), 1e-15);
  EXPECT_NEAR(mass["influence_radius"].get<double>(), 100.0, 1e-12);
  ASSERT_EQ(told["portals"].size(), 2u);
  EXPECT_EQ(told["portals"][0]["pair"], "b");
  EXPECT_EQ(told["portals"][0]["size"], json({2.0, 3.0}));
  EXPECT_EQ(told["objects"][0]["kind"], "sphere");
  EXPECT_EQ(told["camera"]["type"], "perspective");

  const Outcome text = run_portalens(folder.path(), {"check", "scene.toml"});
  ASSERT_EQ(text.code, 0);
  for (const char* part : {"ball", "r_s", "a -> b", "b -> a", "8 x 6"})
    EXPECT_NE(text.output.find(part), std::string::npos) << part << '\n' << text.output;
}

TEST(Check, AFileOutsideTheSceneFolderNeedsTheUsersLeave) {
  const SceneFolder outside, folder;
  outside.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  folder.write("scene.toml",
               tiny + "[[mesh]]\nfile = \"" + (outside.path() / "mesh.obj").string() + "\"\n");
  const Outcome refused = run_portalens(folder.path(), {"check", "scene.toml"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.errors.find("scene.toml:17: "), std::string::npos) << refused.errors;
  const Outcome allowed =
      run_portalens(folder.path(), {"check", "scene.toml", "--allow-outside-files"});
  EXPECT_EQ(allowed.code, 0) << allowed.errors;
}

}  // namespace
}  // namespace portalens
