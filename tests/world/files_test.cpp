#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

#include "io/image.h"
#include "support/scene_text.h"

namespace portalens {
namespace {

using test::compiled;
using test::faults_of;
using test::Folder;

void write_picture(const std::filesystem::path& file) {
  write_image(file, 2, 1, {{"R", {0.25f, 1}}, {"G", {0.5f, 1}}, {"B", {0.75f, 1}}}, {});
}

const Picture& picture_of(const Material& material) {
  return std::get<Picture>(*std::get<DiffuseMirror>(material.bsdf()).textures()[0]);
}

TEST(Files, AnImageIsReadOnceHoweverManyMaterialsNameIt) {
  const Folder folder;
  write_picture(folder.path() / "p.exr");
  const World world = compiled(folder, R"(
[environment]
image = "p.exr"
rotation = 90
[[material]]
diffuse = "p.exr"
[[material]]
diffuse = "./p.exr"
)");
  const auto& materials = world.appearance.materials;
  const Image* image = picture_of(materials[0]).image.get();
  EXPECT_EQ(image, picture_of(materials[1]).image.get());
  EXPECT_EQ(image, world.appearance.environment.image.get());
  EXPECT_EQ(world.appearance.environment.rotation, 90.0);
  SurfacePoint point;
  point.u = 0.25;
  point.v = 0.5;
  EXPECT_EQ(picture_of(materials[0]).at(point), (Rgb{0.25, 0.5, 0.75}));
}

TEST(Files, NegativePixelsBecomeBlackAndAreToldOnce) {
  const Folder folder;
  write_image(folder.path() / "p.exr", 2, 1,
              {{"R", {0.25f, -0.5f}}, {"G", {-0.125f, 1}}, {"B", {0.75f, -0.0f}}}, {});
  const World world = compiled(folder, R"(
[environment]
image = "p.exr"
[[material]]
diffuse = "p.exr"
[[mass]]
center = [0, 0, 0]
mass = 1
)");
  EXPECT_EQ(world.appearance.environment.image->pixels,
            (std::vector<float>{0.25f, 0.0f, 0.75f, 0.0f, 1.0f, 0.0f}));
  ASSERT_EQ(world.warnings.size(), 1u);
  EXPECT_EQ(world.warnings[0],
            "the image 'p.exr' has 2 negative values, taken for 0: the least is -0.5, at pixel "
            "(1, 0)");
}

TEST(Files, OutsideTheFolderAreReadOnlyIfAllowed) {
  const Folder folder;
  std::filesystem::create_directory(folder.path() / "inner");
  write_picture(folder.path() / "p.exr");
  const auto file = folder.write("inner/scene.toml", "[[material]]\ndiffuse = \"../p.exr\"\n");
  EXPECT_THROW((void)compile(read_scene(file)), SceneError);
  const World world = compile(read_scene(file), {Containment::anywhere});
  EXPECT_EQ(picture_of(world.appearance.materials[0]).image->width, 2);
}

TEST(Files, TheTexturesOfAMeshLieBesideIt) {
  const Folder folder;
  std::filesystem::create_directory(folder.path() / "inner");
  write_picture(folder.path() / "inner/p.exr");
  folder.write("inner/m.mtl", "newmtl a\nKd 1 1 1\nmap_Kd p.exr\n");
  folder.write("inner/m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
  const World world = compiled(folder, "[[mesh]]\nfile = \"inner/m.obj\"\n");
  const Body& body = world.appearance.bodies[0];
  EXPECT_EQ(picture_of(world.appearance.materials[body.material_of(0)]).image->width, 2);
}

TEST(Files, AMeshWithFaultsIsNamedWhereTheSceneAsksForIt) {
  const Folder folder;
  folder.write("m.obj", "v 0 0 0\nf 1 2 3\n");
  const std::vector<Fault> faults = faults_of(folder, "\n\n[[mesh]]\nfile = \"m.obj\"\n");
  ASSERT_GT(faults.size(), 1u);
  EXPECT_EQ(faults[0].where.file->substr(faults[0].where.file->size() - 5), "m.obj");
  EXPECT_EQ(faults[0].where.line, 2);
  EXPECT_EQ(faults.back().problem, "the mesh 'm.obj' has faults");
  EXPECT_EQ(faults.back().where.line, 4);
}

TEST(Files, ASceneOfTheDialectCompiles) {
  const Folder folder;
  const auto file = folder.write("a.obj", R"(
PerspectiveCamera {
camera_position < 0, 1, 9 >
point_of_interest < 0, 1, 0 >
up < 0, 1, 0 >
angle 30
}
physics G 2
material
diffuse 1 0 0
reflective 0 0 0
emitted 0 0 0
material
diffuse 0 0 0
reflective 0 0 0
emitted 5 5 5
v -1 0 0
v 1 0 0
v 1 2 0
v -1 2 0
v -1 0 -5
v 1 0 -5
v 1 2 -5
v -1 2 -5
m 0
mass 10
s 0 1 3 0.5
m 1
f 1 2 3 4
p 1 2 3 4 7
p 5 6 7 8 7
)");
  const World world = compile(read_scene(file));
  EXPECT_EQ(world.camera.fov_axis, FovAxis::smaller);
  EXPECT_EQ(world.camera.fov, 30.0);
  EXPECT_EQ(world.appearance.environment.color, (Rgb{1, 1, 1}));
  ASSERT_EQ(world.space.masses.size(), 1u);
  EXPECT_DOUBLE_EQ(world.space.masses[0].gm, 20.0);
  EXPECT_EQ(world.space.masses[0].name, "sphere0");
  ASSERT_EQ(world.appearance.lights.size(), 1u);
  EXPECT_EQ(world.appearance.light_names[0], "quad0");
  ASSERT_EQ(world.space.portals.portals().size(), 2u);
  EXPECT_EQ(world.space.portals.portals()[0].pair, 1u);
}

}  // namespace
}  // namespace portalens
