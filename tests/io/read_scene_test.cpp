// A scene is what its file says: every value with its place, objects in the order of the file.
#include "io/read_scene.h"

#include <gtest/gtest.h>

#include "io/scene_values.h"
#include "io/toml_depth.h"
#include "support/temporary_folder.h"

namespace portalens::test {
namespace {

Scene scene_from(const std::string& name, const std::string& text) {
  const TemporaryFolder folder;
  Scene scene = read_scene(folder.write(name, text));
  EXPECT_NO_THROW(scene.faults.raise());
  return scene;
}

TEST(TomlScene, ObjectsStandInTheOrderOfTheFileWhateverTheirKind) {
  const Scene scene = scene_from("a.toml",
                                 "[[sphere]]\nradius = 1.0\n[[cube]]\n[[sphere]]\n[[portal]]\n"
                                 "[[cone]]\n[[cube]]\n[[mass]]\n");
  std::string order;
  int line = 0;
  for (const Table& table : scene.objects) {
    order += table.kind + " ";
    EXPECT_GT(table.where.line, line);
    line = table.where.line;
  }
  EXPECT_EQ(order, "sphere cube sphere portal cone cube mass ");
}

TEST(TomlScene, EveryValueHasItsLineAndItsType) {
  const Scene scene =
      scene_from("a.toml",
                 "# first\n[film]\nheight = 2\nwidth = 1\n\n[shading]\nambient = [\n"
                 " 0.5,\n 1,\n]\nflag = true\n");
  ASSERT_EQ(scene.film.entries.size(), 2U);
  EXPECT_EQ(scene.film.where.line, 2);
  EXPECT_EQ(scene.film.entries[0].key, "height");  // of the file, not of the alphabet
  EXPECT_EQ(scene.film.entries[1].value.where.line, 4);
  EXPECT_EQ(std::get<std::int64_t>(scene.film.find("width")->data), 1);
  const auto& list = std::get<Value::List>(scene.shading.find("ambient")->data);
  EXPECT_EQ(scene.shading.find("ambient")->where.line, 7);
  EXPECT_EQ(list[0].where.line, 8);
  EXPECT_EQ(list[1].where.line, 9);
  EXPECT_TRUE(std::get<bool>(scene.shading.find("flag")->data));
  EXPECT_FALSE(scene.has_camera);
}

TEST(TomlScene, InlineTablesAreTheSameAsTablesOfTheirOwn) {
  const Scene scene = scene_from(
      "a.toml", "camera = { fov = 30.0 }\nsphere = [{ radius = 2.0 }, { radius = 3.0 }]\n");
  EXPECT_TRUE(scene.has_camera);
  EXPECT_EQ(number_of(scene.camera, "fov"), 30.0);
  ASSERT_EQ(scene.objects.size(), 2U);
  EXPECT_EQ(number_of(scene.objects[1], "radius"), 3.0);
}

TEST(TomlDepth, CountsWhatTheParserWouldRecurseInto) {
  const TomlDepth depth =
      toml_depth("a.b.c = [[1, 2.5], [{ x.y = 1 }]] # [[[ ....\nb = '[[[[....'\n");
  EXPECT_EQ(depth.brackets, 3);
  EXPECT_EQ(depth.dots, 2);
  EXPECT_EQ(depth.dots_line, 1);
}

TEST(TomlDepth, StringsEndWhereTomlEndsThem) {
  for (const char* text :
       {"a = \"\\\"[[[\"\n", "a = '''[[' '' [['''\n", "a = \"\"\"[[\\\"\"\" [[\"\"\"\n",
        "a = \"\"\"x\"\"\"\"\"\n", "a = ''\n", "a = \"\"\n", "\"[[\".b = 1\n"}) {
    const TomlDepth depth = toml_depth(std::string(text) + "b = [1]\n");
    EXPECT_EQ(depth.brackets, 1) << text;
    EXPECT_EQ(depth.brackets_line, 2) << text;
  }
}

constexpr const char* small_obj = R"(# the paper's kind of file
v 0 0 0 vt 0 0
v 1 0 0 vt 1 0
v 1 1 0 vt 1 1
v 0 1 0 vt 0 1
material
  diffuse 1 0.5 0
  reflective 0 0.25 0
  emitted 0 0 0
material texture_file wood.png reflective 0 0 0 roughness 0.1 emitted 3 3 3
f 1 2 3 4
m 1
f 1/4 2/3 3/2
mass 12 1 2 3
s 1 2 3
4
p 1 2 3 4 7 p 4 3 2 1 7
r 1 2 3 2 0.5 1
physics min_force 0.5 physics integrator euler physics max_steps 7
background_color 0.5 0 1
PerspectiveCamera {
  camera_position <1,2,3>
  point_of_interest < 0, 0, 0 >
  up < 0 , 1, 0 >
  angle 30 }
)";

TEST(ObjScene, FacesBecomeQuadsWithTextureCoordinates) {
  const Scene scene = scene_from("a.obj", small_obj);
  ASSERT_EQ(scene.objects.size(), 6U);
  const Table& quad = scene.objects[0];
  EXPECT_EQ(quad.kind, "quad");
  EXPECT_EQ(numbers_of(*quad.find("vertices")), (Numbers{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}));
  EXPECT_EQ(numbers_of(*quad.find("texture_coordinates")), (Numbers{0, 0, 1, 0, 1, 1, 0, 1}));
  EXPECT_EQ(text_of(quad, "material"), "material0");  // before any m
  const Table& triangle = scene.objects[1];
  EXPECT_EQ(numbers_of(*triangle.find("vertices")), (Numbers{0, 0, 0, 1, 0, 0, 1, 1, 0}));
  EXPECT_EQ(numbers_of(*triangle.find("texture_coordinates")), (Numbers{0, 1, 1, 1, 1, 0}));
  EXPECT_EQ(text_of(triangle, "material"), "material1");
}

TEST(ObjScene, RoundThingsBecomeOurs) {
  const Scene scene = scene_from("a.obj", small_obj);
  const Table& sphere = scene.objects[2];
  EXPECT_EQ(sphere.kind, "sphere");
  EXPECT_EQ(sphere.where.line, 15);
  EXPECT_EQ(number_of(sphere, "radius"), 4.0);  // from the next line
  EXPECT_EQ(number_of(sphere, "mass"), 12.0);
  EXPECT_EQ(numbers_of(*sphere.find("center_of_mass")), (Numbers{1, 2, 3}));
  const Table& ring = scene.objects[5];
  EXPECT_EQ(ring.kind, "ring");
  EXPECT_EQ(numbers_of(*ring.find("base")), (Numbers{1, 1, 3}));  // it stands on it
  EXPECT_EQ(number_of(ring, "height"), 2.0);
  EXPECT_EQ(number_of(ring, "inner_radius"), 0.5);
  EXPECT_EQ(number_of(ring, "outer_radius"), 1.0);
  EXPECT_EQ(ring.find("mass"), nullptr);
}

TEST(ObjScene, PortalsOfOneNumberNameEachOther) {
  const Scene scene = scene_from("a.obj", small_obj);
  EXPECT_EQ(text_of(scene.objects[3], "name"), "portal7a");
  EXPECT_EQ(text_of(scene.objects[3], "pair"), "portal7b");
  EXPECT_EQ(text_of(scene.objects[4], "name"), "portal7b");
  EXPECT_EQ(text_of(scene.objects[4], "pair"), "portal7a");
  EXPECT_EQ(scene.objects[3].find("material"), nullptr);
}

TEST(ObjScene, MaterialsAreCountedAndNamed) {
  const Scene scene = scene_from("a.obj", small_obj);
  ASSERT_EQ(scene.materials.size(), 2U);
  EXPECT_EQ(text_of(scene.materials[0], "name"), "material0");
  EXPECT_EQ(numbers_of(*scene.materials[0].find("reflective")), (Numbers{0, 0.25, 0}));
  EXPECT_EQ(text_of(scene.materials[1], "diffuse"), "wood.png");
  EXPECT_EQ(number_of(scene.materials[1], "roughness"), 0.1);
  EXPECT_EQ(scene.notes.size(), 1U);  // that emitted means something else here
}

TEST(ObjScene, CameraBackgroundAndPhysicsBecomeOurs) {
  const Scene scene = scene_from("a.obj", small_obj);
  EXPECT_TRUE(scene.has_camera);
  EXPECT_EQ(text_of(scene.camera, "type"), "perspective");
  EXPECT_EQ(text_of(scene.camera, "fov_axis"), "smaller");
  EXPECT_EQ(number_of(scene.camera, "fov"), 30.0);
  EXPECT_EQ(numbers_of(*scene.camera.find("position")), (Numbers{1, 2, 3}));
  const auto color = numbers_of(*scene.environment.find("color"));
  EXPECT_NEAR(color[0], 0.21404114, 1e-8);
  EXPECT_EQ(color[1], 0.0);
  EXPECT_EQ(color[2], 1.0);
  EXPECT_EQ(number_of(scene.physics, "min_force"), 0.5);
  EXPECT_EQ(std::get<std::int64_t>(scene.physics.find("max_steps")->data), 7);
  EXPECT_EQ(text_of(scene.physics, "integrator"), "euler");
}

TEST(ObjScene, WithoutBackgroundAndMaterialItIsWhiteAndPlain) {
  const Scene scene = scene_from("a.obj", "s 0 0 0 1");
  EXPECT_EQ(numbers_of(*scene.environment.find("color")), (Numbers{1, 1, 1}));
  EXPECT_EQ(scene.objects[0].find("material"), nullptr);
  EXPECT_FALSE(scene.has_camera);
  EXPECT_TRUE(scene.notes.empty());
}

TEST(ObjScene, OneTextureCoordinateMissingLeavesThemAllOut) {
  const Scene scene = scene_from("a.obj", "v 0 0 0 vt 0 0 v 1 0 0 vt 1 0 v 1 1 0\nf 1 2 3\n");
  EXPECT_EQ(scene.objects[0].find("texture_coordinates"), nullptr);
}

TEST(ObjScene, WhiteSpaceAndCommentsMakeNoDifference) {
  const std::string text = small_obj;
  std::string spread;
  for (const char letter : text.substr(text.find('\n'))) {
    spread += letter == ' ' ? std::string(" # f x\r\n\t") : std::string(1, letter);
  }
  const Scene a = scene_from("a.obj", text), b = scene_from("a.obj", spread);
  ASSERT_EQ(a.objects.size(), b.objects.size());
  for (std::size_t i = 0; i < a.objects.size(); ++i) {
    EXPECT_EQ(a.objects[i].kind, b.objects[i].kind);
    EXPECT_EQ(a.objects[i].entries.size(), b.objects[i].entries.size());
  }
}

TEST(ObjScene, TheKindOfAnObjIsToldByItsStatements) {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  std::string many = points;
  for (int i = 0; i < 1001; ++i) many += "f 1 2 3\n";
  const std::pair<std::string, const char*> cases[] = {
      {points + "f 1 2 3 4\n", "quad"},
      {points + "f 1 2 3 4 m 0 f 1 2 3\nmaterial diffuse 1 1 1 reflective 0 0 0 emitted 0 0 0",
       "quad"},
      {points + "s 0 0 0 1 f 1 2 3 4\n", "sphere"},
      {points + "f 1 2 3 4\nmass 2 s 0 0 0 1\n", "quad"},
      {many, "mesh"},
      {many + "m 0 material diffuse 1 1 1 reflective 0 0 0 emitted 0 0 0", "quad"},
      {points + "s off\nf 1 2 3 4\n", "mesh"},
      {points + "s 1\nf 1 2 3 4\n", "mesh"},
      {points + "o m\nf 1 2 3 4\n", "mesh"},
      {points + "f 1 2 3 4 1\n", "mesh"},
      {points + "f -1 -2 -3\n", "mesh"},
      {"v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nf 1 2 3\n", "mesh"},   // colours
      {"v 0 0 0 1\nv 1 0 0 1\nv 1 1 0 1\nf 1 2 3\n", "mesh"},               // weights
      {points + "v 0 1 0.1\nf 1 2 3 4\nf 1/1 2/2 3/3 5/4\n", "mesh"},       // not flat
      {points + "v 0 1 0.1\nf 1 2 3 5\nmass 2 s 0 0 0 1\n", "quad"},        // but a mass
      {points + "v 0 1 5e-7\nf 1 2 3 5\n", "quad"},                         // flat enough
      {"v 0 0 0 v 9 9 9\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 3 4 5\n", "quad"},  // two on a line
      {"v 0 0\n0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n", "quad"}};
  for (const auto& [text, kind] : cases) {
    const Scene scene = scene_from("a.obj", text);
    ASSERT_FALSE(scene.objects.empty()) << text;
    EXPECT_EQ(scene.objects[0].kind, kind) << text;
  }
}

TEST(ObjScene, AnOrdinaryMeshIsASceneOfOneMesh) {
  const Scene scene = scene_from(
      "bunny.obj",
      "mtllib bunny.mtl\no bunny\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n");
  ASSERT_EQ(scene.objects.size(), 1U);
  EXPECT_EQ(scene.objects[0].kind, "mesh");
  EXPECT_EQ(text_of(scene.objects[0], "file"), "bunny.obj");
  EXPECT_EQ(number_of(scene.objects[0], "smooth"), 40.0);
}

}  // namespace
}  // namespace portalens::test
