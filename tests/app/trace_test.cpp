/// \file
/// `portalens trace`: scene-format.md, section 3.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "support/run_program.h"

namespace portalens {
namespace {

using nlohmann::json;

/// Two walls that face each other, a pair of portals, and a mass whose influence ends well away.
const std::string hole_scene = R"([physics]
portal_gravity = "none"
min_force = 1.0
[camera]
position = [0, 0, 5]
look_at = [0, 0, 0]
[[quad]]
name = "left"
vertices = [[-5, -5, 5], [-5, -5, -5], [-5, 5, -5], [-5, 5, 5]]
[[quad]]
name = "right"
vertices = [[5, -5, 5], [5, -5, -5], [5, 5, -5], [5, 5, 5]]
[[portal]]
name = "blue"
pair = "orange"
vertices = [[-1, -1, -3], [1, -1, -3], [1, 1, -3], [-1, 1, -3]]
[[portal]]
name = "orange"
pair = "blue"
vertices = [[19, 19, 20], [21, 19, 20], [21, 21, 20], [19, 21, 20]]
back = "wall"
[[material]]
name = "wall"
[[mass]]
name = "hole"
center = [100, 0, 0]
mass = 1000
)";

std::vector<json> traced(const std::vector<std::string>& arguments, const std::string& input = "") {
  const SceneFolder folder;
  folder.write("scene.toml", hole_scene);
  std::vector<std::string> words = {"trace", "scene.toml", "--json"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const Outcome outcome = run_portalens(folder.path(), words, input);
  EXPECT_EQ(outcome.code, 0) << outcome.errors;
  EXPECT_EQ(outcome.errors, "");
  std::vector<json> answers;
  std::istringstream lines(outcome.output);
  for (std::string line; std::getline(lines, line);) answers.push_back(json::parse(line));
  return answers;
}

void expect_vector(const json& told, double x, double y, double z) {
  ASSERT_EQ(told.size(), 3u);
  EXPECT_NEAR(told[0].get<double>(), x, 1e-9);
  EXPECT_NEAR(told[1].get<double>(), y, 1e-9);
  EXPECT_NEAR(told[2].get<double>(), z, 1e-9);
}

TEST(Trace, AHitTellsWhereAndWhatAndHowFar) {
  const auto answers = traced({"--ray", "0", "-.5", "0", "-2", "0", "0"});
  ASSERT_EQ(answers.size(), 1u);
  const json& answer = answers[0];
  EXPECT_EQ(answer["fate"], "hit");
  EXPECT_EQ(answer["object"], "left");
  expect_vector(answer["position"], -5, -0.5, 0);
  EXPECT_NEAR(answer["length"].get<double>(), 5.0, 1e-9);
  expect_vector(answer["direction"], -1, 0, 0);
  EXPECT_EQ(answer["turning"], 0.0);
  EXPECT_EQ(answer["crossings"], json::array());
  EXPECT_TRUE(answer["steps"].is_number_unsigned());
  EXPECT_FALSE(answer.contains("path"));
  EXPECT_FALSE(answer.contains("bounces"));
}

TEST(Trace, APhotonThroughAPortalLeavesFromItsPair) {
  const json answer = traced({"--ray", "0.5", "0.25", "0", "0", "0", "-1", "--path"}).at(0);
  EXPECT_EQ(answer["fate"], "escaped");
  EXPECT_TRUE(answer["object"].is_null());
  EXPECT_EQ(answer["crossings"], json({"blue"}));
  expect_vector(answer["direction"], 0, 0, 1);
  const json& path = answer["path"];
  ASSERT_EQ(path.size(), 2u);
  expect_vector(path[0].front(), 0.5, 0.25, 0);
  expect_vector(path[0].back(), 0.5, 0.25, -3);
  expect_vector(path[1].front(), 19.5, 20.25, 20);
  EXPECT_EQ(path[1].back(), answer["position"]);
}

TEST(Trace, APortalsBackAndAMassAreNamed) {
  const auto answers = traced({"--rays", "-"}, "20 20 0  0 0 1\n90 0 0  1 0 0\n");
  ASSERT_EQ(answers.size(), 2u);
  EXPECT_EQ(answers[0]["fate"], "hit");
  EXPECT_EQ(answers[0]["object"], "orange");
  expect_vector(answers[0]["position"], 20, 20, 20);
  EXPECT_EQ(answers[1]["fate"], "absorbed");
  EXPECT_EQ(answers[1]["object"], "hole");
  const double r_s = 2.0 * 1000 / (45.0 * 45.0);
  EXPECT_NEAR(answers[1]["position"][0].get<double>(), 100 - r_s, 1e-6);
}

TEST(Trace, BouncesAreListedAndThePathGoesOn) {
  const json answer =
      traced({"--ray", "0", "0", "0", "-1", "0.1", "0", "--bounces", "3", "--path"}).at(0);
  const double slope = std::sqrt(1.01);
  EXPECT_EQ(answer["fate"], "hit");
  EXPECT_EQ(answer["object"], "right");
  EXPECT_NEAR(answer["length"].get<double>(), 35 * slope, 1e-8);
  expect_vector(answer["position"], 5, 3.5, 0);
  ASSERT_EQ(answer["bounces"].size(), 3u);
  const char* walls[] = {"left", "right", "left"};
  for (int i = 0; i < 3; ++i) {
    const json& bounce = answer["bounces"][i];
    EXPECT_EQ(bounce["object"], walls[i]);
    EXPECT_NEAR(bounce["length"].get<double>(), (5 + 10 * i) * slope, 1e-8);
    expect_vector(bounce["position"], i == 1 ? 5 : -5, 0.5 + i, 0);
  }
  ASSERT_EQ(answer["path"].size(), 1u);
  double length = 0.0;
  const json& way = answer["path"][0];
  for (std::size_t i = 1; i < way.size(); ++i) {
    double square = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double step = way[i][axis].get<double>() - way[i - 1][axis].get<double>();
      square += step * step;
    }
    length += std::sqrt(square);
  }
  EXPECT_NEAR(length, 35 * slope, 1e-8);
}

TEST(Trace, WithoutBouncesLeftThePhotonEndsAtTheWall) {
  const json answer = traced({"--ray", "0", "0", "0", "1", "0", "0", "--bounces", "1"}).at(0);
  EXPECT_EQ(answer["object"], "left");
  EXPECT_EQ(answer["bounces"].size(), 1u);
  EXPECT_EQ(traced({"--ray", "0", "0", "9", "0", "0", "1", "--bounces", "1"}).at(0)["bounces"],
            json::array());
}

TEST(Trace, ManyRaysAreAnsweredInTheirOrderWhateverTheThreads) {
  std::string rays = "# a comment, and an empty line\n\n";
  const int count = 5000;
  for (int i = 0; i < count; ++i)
    rays += "0 " + std::to_string(-4.0 + 8.0 * i / count) + " 0\t1e0 +0 -0.0\r\n";
  const auto one = traced({"--rays", "-", "-t", "1"}, rays);
  ASSERT_EQ(one.size(), static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    ASSERT_NEAR(one[i]["position"][1].get<double>(), -4.0 + 8.0 * i / count, 1e-6);
  EXPECT_EQ(traced({"--rays", "-", "-t", "3"}, rays), one);
}

TEST(Trace, ARayMayBeGivenAgain) {
  const auto answers = traced({"--ray", "0", "0", "0",     "1", "0",  "0", "--ray", "0", "1", "0",
                               "1",     "0", "0", "--ray", "0", "-2", "0", "1",     "0", "0"});
  ASSERT_EQ(answers.size(), 3u);
  for (const auto& [i, y] : {std::pair{0, 0.0}, {1, 1.0}, {2, -2.0}})
    EXPECT_NEAR(answers[i]["position"][1].get<double>(), y, 1e-9);
}

TEST(Trace, MalformedLinesAreAllNamedAndNothingIsAnswered) {
  const SceneFolder folder;
  folder.write("scene.toml", hole_scene);
  folder.write("rays.txt",
               "0 0 0 1 0 0\n"
               "0 0 0 1 0\n"
               "0 0 0 1 0 0 0\n"
               "0 0 zero 1 0 0\n"
               "0 0 0 0 0 0\n"
               "0 0 inf 0 0 1\n"
               "0,0,0,1,0,0\n"
               "0 0 0 0 1 0\n");
  const Outcome outcome =
      run_portalens(folder.path(), {"trace", "scene.toml", "--rays", "rays.txt", "--json"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.output, "");
  for (int line = 2; line <= 7; ++line)
    EXPECT_NE(outcome.errors.find("rays.txt:" + std::to_string(line) + ": "), std::string::npos)
        << outcome.errors;
  EXPECT_EQ(outcome.errors.find("rays.txt:1: "), std::string::npos);
  EXPECT_EQ(outcome.errors.find("rays.txt:8: "), std::string::npos);
}

TEST(Trace, PeopleAreToldInWords) {
  const SceneFolder folder;
  folder.write("scene.toml", hole_scene);
  const Outcome outcome = run_portalens(
      folder.path(),
      {"trace", "scene.toml", "--ray", "0", "0", "0", "-1", "0", "0", "--bounces", "1", "--path"});
  EXPECT_EQ(outcome.code, 0);
  for (const char* part : {"bounce left", "hit right", "length 15", "stretch 0"})
    EXPECT_NE(outcome.output.find(part), std::string::npos) << part << '\n' << outcome.output;
}

/// Light goes straight here: what a pixel's photon meets lies on a straight line from the camera
/// that went through.
TEST(Trace, TellsWhereACameraStandsThatWentThrough) {
  const std::vector<json> answers = traced({"--pixel", "470", "260", "--pixel", "490", "275"});
  for (const json& answer : answers) {
    ASSERT_EQ(answer["crossings"], json({"blue"}));
    const json &camera = answer["camera_beyond"], &end = answer["position"];
    double along = 0.0, length = 0.0;
    for (int i = 0; i < 3; ++i) {
      const double way = end[i].get<double>() - camera["position"][i].get<double>();
      along += way * answer["direction"][i].get<double>();
      length += way * way;
    }
    EXPECT_NEAR(along, std::sqrt(length), 1e-9 * along);
  }
  // 8 before blue, and so 8 behind orange, whose front looks along +z, where the view goes on.
  expect_vector(answers[0]["camera_beyond"]["position"], 20, 20, 12);
  expect_vector(answers[0]["camera_beyond"]["look_at"], 20, 20, 13);
  expect_vector(answers[0]["camera_beyond"]["up"], 0, 1, 0);
  EXPECT_FALSE(traced({"--ray", "0", "0", "0", "1", "0", "0"})[0].contains("camera_beyond"));
  const json by_ray = traced({"--ray", "0", "0", "0", "0", "0", "-1"})[0]["camera_beyond"];
  expect_vector(by_ray["position"], 20, 20, 17);
  expect_vector(by_ray["look_at"], 20, 20, 18);
  const SceneFolder folder;
  folder.write("scene.toml", hole_scene);
  const std::string text = run_portalens(folder.path(), {"check", "scene.toml"}).output;
  EXPECT_NE(text.find("    a camera that goes through stands at\n      position = [20, 20, 12]\n"
                      "      look_at = [20, 20, 13]\n      up = [0, 1, 0]\n"),
            std::string::npos)
      << text;
}

}  // namespace
}  // namespace portalens
