/// \file
/// `portalens field`, and what `check` says of gravity through portals.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "support/run_program.h"

namespace portalens {
namespace {

using nlohmann::json;

/// A portal whose pair is far away, with a mass in front of that.
const std::string field_scene = R"([camera]
position = [0, 12, 0]
look_at = [0, 0, 0]
up = [0, 0, -1]
[environment]
color = [1, 1, 1]
[physics]
min_force = 1.0
[[portal]]
name = "blue & <white>"
pair = "orange"
vertices = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]
[[portal]]
name = "orange"
pair = "blue & <white>"
vertices = [[39, -1, 0], [41, -1, 0], [41, 1, 0], [39, 1, 0]]
[[mass]]
name = "hole"
center = [40, 0, 3]
mass = 400
[[mass]]
name = "near"
center = [0, 5, 0]
mass = 50
)";

class FieldCommand : public testing::Test {
 protected:
  void SetUp() override { folder_.write("scene.toml", field_scene); }

  Outcome run(std::vector<std::string> words) {
    words.insert(words.begin() + 1, "scene.toml");
    return run_portalens(folder_.path(), words);
  }
  json told(const std::vector<std::string>& words) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 0) << outcome.errors;
    return json::parse(outcome.output);
  }

  SceneFolder folder_;
};

double norm(const json& v) {
  return std::hypot(v[0].get<double>(), v[1].get<double>(), v[2].get<double>());
}

TEST_F(FieldCommand, TellsPartsThatMakeUpTheWhole) {
  for (const std::string coupling :
       {"none", "closest-point", "shortest-path", "graviton-map", "portal-mass"}) {
    const json field = told({"field", "--at", "0.3", "0.2", "2", "--json", "--set",
                             "physics.portal_gravity=" + coupling});
    EXPECT_EQ(field["portal_gravity"], coupling);
    double sum[3] = {0, 0, 0};
    for (const char* parts : {"direct", "through_portals"})
      for (const json& part : field[parts])
        for (int k = 0; k < 3; ++k) sum[k] += part["acceleration"][k].get<double>();
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(sum[k], field["acceleration"][k].get<double>(), 1e-12 * 50.0);
    EXPECT_EQ(field["direct"].size(), 1u);
    EXPECT_EQ(field["through_portals"].empty(), coupling == "none");
  }
}

TEST_F(FieldCommand, TellsHowMuchALawLetsItCount) {
  const double c2 = 45.0 * 45.0;
  for (const std::string law : {"newton", "einstein", "schwarzschild", "extreme"}) {
    const json field =
        told({"field", "--at", "0.25", "0", "2", "--json", "--set", "physics.law=" + law});
    EXPECT_EQ(field["law"], law);
    const double direct = 50.0 / std::hypot(0.25, 5.0, 2.0),
                 through = 400.0 / std::hypot(0.25, 3.0);
    const double w = field["w"].get<double>(), h = field["h"].get<double>();
    EXPECT_NEAR(w, (direct + through) / c2, 1e-12);
    const double expected = law == "newton"     ? 1.0
                            : law == "einstein" ? 2.0
                            : law == "extreme"  ? 2.0 / (1.0 + w)
                                                : (2.0 - w / 2.0) / (1.0 - w * w / 4.0);
    EXPECT_NEAR(h, expected, 1e-12);
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(field["pull"][k].get<double>(), h * field["acceleration"][k].get<double>(),
                  1e-12);
  }
}

TEST_F(FieldCommand, TellsTheNearestPointOfAFaceAndWhereItLeads) {
  const json field = told({"field", "--at", "0.25", "0", "2", "--json"});
  const json part = field["through_portals"][0];
  EXPECT_EQ(part["portals"], json::array({"blue & <white>"}));
  EXPECT_EQ(part["distance"], 2.0);
  EXPECT_NEAR(norm(part["places"][0]), 0.25, 1e-12);
  EXPECT_NEAR(part["beyond"][0].get<double>(), 39.75, 1e-12);
  EXPECT_NEAR(norm(part["acceleration"]), 400.0 / (9.0 + 0.0625), 1e-9);
}

TEST_F(FieldCommand, TellsTheShortestWayAndItsBends) {
  const json field = told({"field", "--at", "0.5", "0", "-2", "--json", "--set",
                           "physics.portal_gravity=shortest-path"});
  const json part = field["through_portals"][0];
  EXPECT_EQ(part["mass"], "hole");
  ASSERT_EQ(part["places"].size(), 1u);  // around the rim
  EXPECT_NEAR(part["places"][0][0].get<double>(), 1.0, 1e-9);
  const double way = std::hypot(0.5, 2.0) + std::hypot(1.0, 3.0);
  EXPECT_NEAR(part["distance"].get<double>(), way, 1e-9);
  EXPECT_NEAR(norm(part["acceleration"]), 400.0 / (way * way), 1e-9);
}

TEST_F(FieldCommand, TellsPeopleTheSame) {
  const Outcome outcome = run({"field", "--at", "0.25", "0", "2"});
  EXPECT_EQ(outcome.code, 0);
  for (const char* word : {"directly", "near", "through portals (closest-point, depth 1)", "blue"})
    EXPECT_NE(outcome.output.find(word), std::string::npos) << word;
}

TEST_F(FieldCommand, DrawsAPlane) {
  for (const std::string file : {"field.png", "field.svg"}) {
    const Outcome outcome =
        run({"field", "--plane", "xz", "--cut", "0", "--width", "200", "-o", file});
    EXPECT_EQ(outcome.code, 0) << outcome.errors;
    EXPECT_GT(folder_.read(file).size(), 1000u);
  }
  const std::string svg = folder_.read("field.svg");
  EXPECT_NE(svg.find("blue &amp; &lt;white&gt;</text>"), std::string::npos);
  EXPECT_NE(svg.find("hole</text>"), std::string::npos);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
}

TEST_F(FieldCommand, SeesAPlaneFromOneSideWhateverTheRange) {
  const auto heights = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"field", "--width", "400", "-o", "a.svg", "--plane"});
    EXPECT_EQ(run(words).code, 0);
    const std::string svg = folder_.read("a.svg");
    const auto height = [&](const std::string& name) {
      const std::size_t begin = svg.rfind("<text", svg.find(name + "</text>"));
      return std::stod(svg.substr(svg.find("y=\"", begin) + 3));
    };
    return std::pair{height("hole"), height("near")};
  };
  // From above z points down, as in `draw --view top`; the larger y of two is the lower on paper.
  for (const auto& words :
       {std::vector<std::string>{"xz"}, {"xz", "--range", "-2", "42", "-9", "9"}}) {
    const auto [hole, near] = heights(words);
    EXPECT_GT(hole, near) << words.size();
  }
  for (const auto& words :
       {std::vector<std::string>{"xy"}, {"xy", "--range", "-2", "42", "-9", "9"}}) {
    const auto [hole, near] = heights(words);
    EXPECT_GT(hole, near) << words.size();
  }
  const auto [hole, near] = heights({"xz", "--range", "-2", "42", "9", "-9"});
  EXPECT_LT(hole, near);
}

TEST_F(FieldCommand, TheLegendTellsAxesCutAndLaw) {
  const auto legend_of = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"field", "--width", "200", "-o", "a.svg"});
    EXPECT_EQ(run(words).code, 0);
    return folder_.read("a.svg");
  };
  const auto says = [](const std::string& svg, const std::string& words) {
    return svg.find(words) != std::string::npos;
  };
  const std::string down =
      legend_of({"--plane", "xz", "--cut", "0.5", "--range", "-4", "4", "1", "3"});
  EXPECT_TRUE(says(down, ">x from -4 to 4 to the right, z from 3 to 1 upwards; at y = 0.5<"))
      << down;
  EXPECT_TRUE(says(down, "law newton; closest-point, depth 1")) << down;
  const std::string up =
      legend_of({"--plane", "yz", "--cut", "-2", "--range", "0", "5", "-1", "2"});
  EXPECT_TRUE(says(up, ">y from 0 to 5 to the right, z from -1 to 2 upwards; at x = -2<")) << up;
  const std::string tilted =
      legend_of({"--rectangle", "1", "2", "3", "3", "0", "4", "0", "2", "0"});
  EXPECT_TRUE(says(tilted, ">5 x 2, lower left corner (1, 2, 3)<")) << tilted;
  EXPECT_FALSE(says(tilted, "nothing pulls here"));
  const std::string empty = legend_of({"--plane", "xz", "--range", "100", "101", "900", "901",
                                       "--cut", "500", "--set", "physics.portal_gravity=none"});
  EXPECT_TRUE(says(empty, ">nothing pulls here")) << empty;
}

TEST_F(FieldCommand, ShowsTheInfluenceOfALoneHole) {
  folder_.write("scene.toml",
                "[camera]\nposition = [0, 0, 9]\nlook_at = [0, 0, 0]\n[[mass]]\n"
                "center = [1, 2, 3]\nmass = 1000\n[physics]\nmin_force = 10\n");
  EXPECT_EQ(run({"field", "--plane", "xy", "--width", "100", "-o", "a.svg"}).code, 0);
  // 1.1 times sqrt(1000 / 10) to both sides
  EXPECT_NE(folder_.read("a.svg").find("x from -10 to 12 to the right, y from -9 to 13 upwards"),
            std::string::npos)
      << folder_.read("a.svg");
}

TEST_F(FieldCommand, NamesDoNotCoverEachOther) {
  std::string crowd = "[camera]\nposition = [0, 0, 9]\nlook_at = [0, 0, 0]\n";
  for (int i = 0; i < 4; ++i)
    crowd += "[[mass]]\nname = \"mass " + std::to_string(i) + "\"\ncenter = [" +
             std::to_string(0.01 * i) + ", 0, 0]\nmass = 1\n";
  folder_.write("scene.toml", crowd);
  EXPECT_EQ(run({"field", "--plane", "xy", "--width", "200", "--range", "-1", "1", "-1", "1", "-o",
                 "a.svg"})
                .code,
            0);
  const std::string svg = folder_.read("a.svg");
  std::vector<double> heights;
  for (int i = 0; i < 4; ++i) {
    const std::size_t begin = svg.rfind("<text", svg.find("mass " + std::to_string(i) + "</text>"));
    heights.push_back(std::stod(svg.substr(svg.find("y=\"", begin) + 3)));
  }
  for (std::size_t i = 1; i < heights.size(); ++i) EXPECT_GE(heights[i] - heights[i - 1], 13.9);
}

TEST_F(FieldCommand, ACentreOfAMassHasNoFinitePull) {
  EXPECT_NE(run({"field", "--at", "0", "5", "0"}).output.find("pull has no bound here"),
            std::string::npos);
  EXPECT_EQ(run({"field", "--at", "0", "5", "1"}).output.find("pull has no bound here"),
            std::string::npos);
}

TEST_F(FieldCommand, DrawsTheSameWhateverTheThreads) {
  for (const std::string threads : {"1", "3"})
    EXPECT_EQ(run({"field", "--rectangle", "-2", "-1", "-2", "4", "0", "4", "0", "3", "0", "-t",
                   threads, "--width", "100", "-o", threads + ".svg"})
                  .code,
              0);
  EXPECT_EQ(folder_.read("1.svg"), folder_.read("3.svg"));
}

TEST_F(FieldCommand, RefusesWhatIsNoPlane) {
  const std::vector<std::vector<std::string>> wrong = {
      {"--plane", "xx", "-o", "a.png"},
      {"--plane", "xw", "-o", "a.png"},
      {"--plane", "xz", "-o", "a.jpg"},
      {"--plane", "xz", "--range", "1", "1", "0", "1", "-o", "a.png"},
      {"--rectangle", "0", "0", "0", "1", "0", "0", "1", "1", "0", "-o", "a.png"},
      {"--at", "0", "0", "inf"},
      {"--at", "0", "0", "0", "-o", "a.png"},
      {"--plane", "xz"},
      {}};
  for (std::vector<std::string> words : wrong) {
    words.insert(words.begin(), "field");
    const Outcome outcome = run(words);
    EXPECT_NE(outcome.code, 0) << testing::PrintToString(words);
    EXPECT_NE(outcome.errors, "") << testing::PrintToString(words);
  }
}

TEST_F(FieldCommand, CheckTellsWhatGravityThroughPortalsCosts) {
  const json plain = told({"check", "--json"})["gravity_through_portals"];
  EXPECT_EQ(plain["name"], "closest-point");
  EXPECT_GT(plain["pulls_at_each_place"], 0.0);
  EXPECT_FALSE(plain.contains("map_errors"));
  const json map = told({"check", "--json", "--set", "physics.portal_gravity=graviton-map"});
  const json errors = map["gravity_through_portals"]["map_errors"];
  ASSERT_EQ(errors.size(), 2u);
  EXPECT_GT(errors[0]["typical"], 0.0);
  EXPECT_LT(errors[0]["typical"], 0.01);
  EXPECT_NE(run({"check"}).output.find("through portals: closest-point"), std::string::npos);
}

}  // namespace
}  // namespace portalens
