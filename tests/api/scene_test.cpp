// Scenes of files, of text and of code, as others who use the library give them.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "portalens/portalens.h"
#include "support/scene_folder.h"

namespace portalens::api {
namespace {

constexpr const char* text = R"(
[camera]
position = [0, 1, 6]
look_at = [0, 1, 0]
[film]
width = 24
height = 16
[environment]
color = [0.2, 0.3, 0.5]
[[material]]
name = "tiles"
diffuse = { checker = [[0.8, 0.8, 0.7], [0.1, 0.1, 0.3]], size = 1 }
[[light]]
position = [-4, 8, 6]
intensity = [250, 250, 230]
[[quad]]
vertices = [[-9, 0, 8], [9, 0, 8], [9, 0, -9], [-9, 0, -9]]
material = "tiles"
[[mass]]
name = "hole"
center = [0, 1, 0]
mass = 150.0
)";

Scene built_in_code() {
  Scene scene;
  scene.set("camera", {{"position", Vec3{0, 1, 6}}, {"look_at", {0, 1, 0}}});
  scene.set("film", {{"width", 24}, {"height", 16u}});
  scene.set("environment", {{"color", {0.2, 0.3, 0.5}}});
  const Entries checker = {{"checker", {{0.8, 0.8, 0.7}, {0.1, 0.1, 0.3}}}, {"size", 1}};
  scene.add("material", {{"name", "tiles"}, {"diffuse", checker}});
  scene.add("light", {{"position", {-4, 8, 6}}, {"intensity", {250, 250, 230}}});
  const std::vector<Vec3> floor = {{-9, 0, 8}, {9, 0, 8}, {9, 0, -9}, {-9, 0, -9}};
  scene.add("quad", {{"vertices", floor}, {"material", std::string("tiles")}});
  scene.add("mass", {{"name", "hole"}, {"center", {0, 1, 0}}, {"mass", 150.0f}});
  return scene;
}

TEST(ApiScene, GivesTheSamePictureFromCodeFromTextAndFromAFile) {
  const SceneFolder folder;
  const Scene file = Scene::from_file(folder.write("scene.toml", text));
  const Picture of_file = render(compile(file)).picture;
  EXPECT_EQ(render(compile(Scene::from_text(text))).picture.rgb, of_file.rgb);
  EXPECT_EQ(render(compile(built_in_code())).picture.rgb, of_file.rgb);
}

TEST(ApiScene, SeeksTheFilesOfATextInTheFolderOfItsName) {
  const SceneFolder folder;
  folder.write("corner.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string mesh = std::string(text) + "[[mesh]]\nfile = \"corner.obj\"\n";
  EXPECT_TRUE(check(Scene::from_text(mesh, folder.path() / "none.toml")).sound());
  const std::filesystem::path other = folder.path() / "other";
  std::filesystem::create_directory(other);
  const Report elsewhere = check(Scene::from_text(mesh, other / "none.toml"));
  ASSERT_EQ(elsewhere.faults.size(), 1u);
  EXPECT_NE(elsewhere.faults[0].problem.find("corner.obj"), std::string::npos);
}

TEST(ApiScene, FaultsOfCodeNameTheCallsAndStandTogether) {
  Scene scene = built_in_code();
  scene.add("sphere", {{"center", {0, 1, 0}}, {"radius", -1.0}});
  const int line = __LINE__ - 1;
  scene.add("spere", {});
  scene.set("films", {{"width", 3}});
  scene.assign("physics.tolerance=1e-5.3");
  const Report report = check(scene);
  ASSERT_EQ(report.faults.size(), 4u);
  EXPECT_FALSE(report.sound());
  const auto at = [&](int there) {
    for (const Fault& fault : report.faults)
      if (fault.line == there && fault.file == __FILE__) return fault;
    return Fault{};
  };
  EXPECT_NE(at(line).problem.find("radius"), std::string::npos) << at(line).problem;
  EXPECT_NE(at(line + 2).remedy.find("sphere"), std::string::npos) << at(line + 2).remedy;
  EXPECT_NE(at(line + 3).remedy.find("film"), std::string::npos) << at(line + 3).remedy;
}

TEST(ApiScene, OneErrorCarriesAllFaultsAndSaysThem) {
  try {
    static_cast<void>(compile(Scene::from_text(
        "[film]\nwidth = 0\n[[sphere]]\ncenter = [0, 0, 0]\nradius = \"big\"\n", "bad.toml")));
    FAIL() << "it compiled";
  } catch (const Error& error) {
    EXPECT_EQ(error.cause(), Cause::asked);
    ASSERT_EQ(error.faults().size(), 2u);
    EXPECT_EQ(error.faults()[0].file, "bad.toml");
    EXPECT_EQ(error.faults()[0].line, 2);
    EXPECT_EQ(error.faults()[1].line, 5);
    const std::string all = to_string(error.faults()[0]) + '\n' + to_string(error.faults()[1]);
    EXPECT_EQ(error.what(), all);
  }
}

TEST(ApiScene, ASyntaxErrorAndAMissingFileAreFaultsOfTheFile) {
  const SceneFolder folder;
  const Report syntax = check_file(folder.write("scene.toml", "[camera\n"));
  ASSERT_EQ(syntax.faults.size(), 1u);
  EXPECT_EQ(syntax.faults[0].line, 1);
  EXPECT_EQ(check_file(folder.path() / "none.toml").faults.size(), 1u);
  EXPECT_THROW(static_cast<void>(Scene::from_text("")), Error);
}

TEST(ApiScene, CopiesAreIndependent) {
  const Scene original = built_in_code();
  Scene copy = original;
  copy.set("film", {{"width", 48}});
  EXPECT_EQ(compile(original).width(), 24);
  EXPECT_EQ(compile(copy).width(), 48);
  EXPECT_EQ(compile(copy).height(), 16) << "a key that was not named keeps what it had";
  copy = original;
  copy.assign("film.width=12");
  EXPECT_EQ(compile(copy).width(), 12);
  EXPECT_EQ(compile(original).width(), 24);
}

TEST(ApiScene, ASummaryTellsWhatAWorldHolds) {
  Scene scene = built_in_code();
  scene.add("portal", {{"name", "in"},
                       {"pair", "out"},
                       {"vertices", {{-3, 0, -1}, {-2, 0, -1}, {-2, 2, -1}, {-3, 2, -1}}}});
  scene.add("portal", {{"name", "out"},
                       {"pair", "in"},
                       {"vertices", {{2, 0, -1}, {3, 0, -1}, {3, 2, -1}, {2, 2, -1}}}});
  const Summary summary = compile(scene).summary();
  ASSERT_EQ(summary.objects.size(), 1u);
  EXPECT_EQ(summary.objects[0].kind, "quad");
  EXPECT_EQ(summary.objects[0].material, "tiles");
  ASSERT_EQ(summary.masses.size(), 1u);
  EXPECT_EQ(summary.masses[0].name, "hole");
  EXPECT_DOUBLE_EQ(summary.masses[0].mass, 150.0);
  EXPECT_DOUBLE_EQ(summary.masses[0].horizon_radius, 2 * 150.0 / (45.0 * 45.0));
  ASSERT_EQ(summary.portals.size(), 2u);
  EXPECT_EQ(summary.portals[0].pair, "out");
  EXPECT_EQ(summary.portals[0].normal, (Vec3{0, 0, 1}));
}

TEST(ApiScene, TheVersionOfTheLibraryIsThatOfTheHeaders) { EXPECT_EQ(linked_version(), version); }

}  // namespace
}  // namespace portalens::api
