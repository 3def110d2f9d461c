/// \file
/// The program from end to end: what it says of itself and of a scene, and how it exits.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "portalens/version.h"
#include "support/run_program.h"
#include "support/tiny_scene.h"

namespace portalens {
namespace {

using nlohmann::json;

TEST(Program, TeachesWhatItDoes) {
  const SceneFolder folder;
  const Outcome help = run_portalens(folder.path(), {"--help"});
  EXPECT_EQ(help.code, 0);
  for (const char* word : {"render", "check", "trace", "Examples"})
    EXPECT_NE(help.output.find(word), std::string::npos) << word;
  for (const char* command : {"render", "check", "trace"})
    EXPECT_EQ(run_portalens(folder.path(), {command, "--help"}).code, 0);
  EXPECT_EQ(run_portalens(folder.path(), {"help"}).output, help.output);
  const Outcome mistyped = run_portalens(folder.path(), {"help", "rendr"});
  EXPECT_EQ(mistyped.code, 2);
  EXPECT_NE(mistyped.errors.find("did you mean render?"), std::string::npos) << mistyped.errors;
  EXPECT_EQ(run_portalens(folder.path(), {"help", "trace"}).output,
            run_portalens(folder.path(), {"trace", "--help"}).output);
  const Outcome version = run_portalens(folder.path(), {"--version"});
  EXPECT_EQ(version.code, 0);
  EXPECT_EQ(version.output, "portalens " + std::string(api::version) + "\n");
}

TEST(Program, WhatIsMistypedIsToldInWordsThatHelp) {
  const SceneFolder folder;
  folder.write("tiny.toml", tiny);
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"render", "tiny.toml", "--width", "8x6"}, "--width: '8x6' is not a whole number; write"},
      {{"render", "tiny.toml", "--width"}, "--width lacks values; write --width INT"},
      {{"render", "tiny.toml", "--layers", "-o", "a.exr"},
       "--layers lacks values; write --layers "},
      {{"render", "tiny.toml", "--tone", "agx"}, "did you mean agx-like?"},
      {{"trace", "tiny.toml", "--ray", "1", "2", "3", "4", "5"},
       "--ray has 5 values, not 6; write --ray X Y Z DX DY DZ"},
      {{"render", "tiny.toml", "--resume", "--restart"},
       "exclude each other; leave one of them out"},
      {{"field", "tiny.toml", "--at", "0", "0", "0", "--cut", "1"},
       "--cut is of use only with --plane; give that, too"},
      {{"render", "tiny.toml", "--layers", "dpeth"}, "unknown 'dpeth'; did you mean depth?"},
      {{"render", "tiny.toml", "--set", "sphere.ball.radius=-1"}, "--set sphere.ball.radius=-1: "},
      {{"render", "tiny.toml", "--set", "flim.width=3", "--set", "sphere.bal.radius=2"},
       "--set sphere.bal.radius=2: no [[sphere]] is named 'bal'"},
      {{"render", "tiny.toml", "--set", "flim.width=3", "--set", "sphere.bal.radius=2"},
       "--set flim.width=3: unknown section 'flim'; did you mean film?"},
      {{"render", "tiny.toml", "--exposure", "much"}, "--exposure: "},
      {{"render", "tiny.toml", "--width", "99999999999"}, "'99999999999' is not in range"},
      {{"render", "tiny.toml", "--crop", "1", "2"}, "write --crop X0 Y0 X1 Y1"},
      {{"render", std::string(50000, 'a') + ".toml", "--width", std::string(50000, 'x')},
       "is not a whole number"}};
  for (const auto& [words, told] : wrong) {
    const Outcome outcome = run_portalens(folder.path(), words);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.errors.find(told), std::string::npos) << outcome.errors;
  }
}

TEST(Program, WhatWasReadIsNeverWrittenOver) {
  const SceneFolder folder;
  const std::string sky = "[environment]\nimage = \"sky.png\"\n";
  const std::string color = "[environment]\ncolor = [0.25, 0.5, 0.75]\n";
  std::string scene = tiny;
  folder.write("plain.toml", scene);
  ASSERT_EQ(run_portalens(folder.path(), {"render", "plain.toml", "-o", "sky.png"}).code, 0);
  ASSERT_EQ(run_portalens(folder.path(), {"render", "plain.toml", "-o", "a.exr"}).code, 0);
  ASSERT_EQ(run_portalens(folder.path(), {"render", "plain.toml", "-o", "a.part"}).code, 0);
  folder.write("sky.toml", scene.replace(scene.find(color), color.size(), sky));
  folder.write("ball.obj", "o ball\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  folder.write("ball.toml", tiny + "[[mesh]]\nfile = \"ball.obj\"\n");
  std::filesystem::create_hard_link(folder.path() / "sky.png", folder.path() / "same.png");
  const std::vector<std::vector<std::string>> commands = {
      {"render", "sky.toml"},
      {"render", "sky.toml", "-o", "same.png"},
      {"draw", "sky.toml", "-o", "./sky.png"},
      {"field", "sky.toml", "--plane", "xy", "-o", "sky.png"},
      {"trace", "ball.toml", "--pixel", "1", "1", "-o", "ball.obj"},
      {"render", "--from", "a.exr", "-o", "a.exr"},
      {"merge", "a.part", "-o", "a.part"},
      {"image", "a.exr", "-o", "a.exr"},
      {"image", "--compare", "sky.png", "same.png", "-o", "sky.png"}};
  const auto all = [&] {
    return folder.read("sky.png") + folder.read("ball.obj") + folder.read("a.exr") +
           folder.read("a.part");
  };
  const std::string before = all();
  for (const std::vector<std::string>& words : commands) {
    const Outcome outcome = run_portalens(folder.path(), words);
    EXPECT_EQ(outcome.code, 2) << quoted(words);
    EXPECT_NE(outcome.errors.find("would be written over what it is made from"), std::string::npos)
        << quoted(words) << outcome.errors;
  }
  EXPECT_EQ(all(), before);
}

TEST(Program, ASceneMayBeNamedLast) {
  const SceneFolder folder;
  folder.write("tiny.toml", tiny);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"render", "--crop", "0", "0", "3", "3", "tiny.toml"},
        {"render", "-o", "a.exr", "--layers", "depth", "tiny.toml"},
        {"trace", "--ray", "0", "0", "5", "0", "0", "-1", "tiny.toml"},
        {"trace", "--pixel", "1", "1", "tiny.toml"},
        {"field", "--at", "0", "0", "3", "tiny.toml"}}) {
    const Outcome outcome = run_portalens(folder.path(), words);
    EXPECT_EQ(outcome.code, 0) << outcome.errors;
  }
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
      {{"render", "tiny.toml", "--width", "wide"},
       "--width: 'wide' is not a whole number; write --width INT"},
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
