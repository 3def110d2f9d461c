// A model without a scene gets a camera and lamps that suit it.
#include "world/stage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "io/override.h"
#include "support/random.h"
#include "support/scene_text.h"

namespace portalens {
namespace {

using test::Folder;

World alone(const std::string& obj, const std::vector<std::string>& settings = {}) {
  const Folder folder;
  Scene scene = read_scene(folder.write("model.obj", obj));
  for (const std::string& setting : settings) override_value(scene, setting, scene.faults);
  return compile(scene);
}

std::string vertex(Vec3d v) {
  return "v " + std::to_string(v.x) + ' ' + std::to_string(v.y) + ' ' + std::to_string(v.z) + '\n';
}

/// A rectangle about the origin, that faces `normal`.
std::string plane(Vec3d normal, double width, double height) {
  const Vec3d across = any_perpendicular(normal) * width;
  const Vec3d along = cross(normal, normalize(across)) * height;
  return "o plane\n" + vertex(-across - along) + vertex(across - along) + vertex(across + along) +
         vertex(along - across) + "f 1 2 3 4\n";
}

std::string box(Vec3d from, Vec3d size) {
  std::string text = "o box\n";
  for (const double x : {0.0, 1.0})
    for (const double y : {0.0, 1.0})
      for (const double z : {0.0, 1.0}) text += vertex(from + Vec3d{x, y, z} * size);
  return text + "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n";
}

const Mesh& mesh_of(const World& world) { return std::get<Mesh>(world.space.surfaces.shapes()[0]); }

/// How far the model goes towards the nearest side of the film, of what there is.
double filled(const World& world) {
  const Camera& camera = world.camera;
  const Vec3d edge = camera.ray(0, 0, world.film.width, world.film.height).direction;
  const double depth = dot(edge, camera.forward);
  const double half_x = -dot(edge, camera.right) / depth, half_y = dot(edge, camera.up) / depth;
  double most = 0.0;
  for (std::uint32_t face = 0; face < mesh_of(world).triangle_count(); ++face)
    for (const Vec3d& corner : mesh_of(world).triangle(face)) {
      const Vec3d way = corner - camera.position;
      const double far = dot(way, camera.forward);
      EXPECT_GT(far, 0.0);
      most = std::fmax(most, std::fabs(dot(way, camera.right)) / far / half_x);
      most = std::fmax(most, std::fabs(dot(way, camera.up)) / far / half_y);
    }
  return most;
}

TEST(Stage, AModelIsSeenWholeAndFillsTheView) {
  for (const std::string& model :
       {box({0, 0, 0}, {1, 1, 1}), box({1000, -20, 3}, {1, 50, 2}), box({0, 0, 0}, {60, 1, 30}),
        plane({0, 1, 0}, 4, 2), plane({1, 0, 0}, 1e-3, 2e-3), plane({0, 0, -1}, 1e5, 1)}) {
    for (const char* width : {"film.width=300", "film.width=960"}) {
      const World world = alone(model, {width});
      EXPECT_LT(filled(world), 0.97) << model;
      EXPECT_GT(filled(world), 0.75) << model;
    }
  }
}

TEST(Stage, TheUsualViewIsALittleFromAboveAndFromTheRight) {
  const Vec3d forward = alone(box({-1, -1, -1}, {2, 2, 2})).camera.forward;
  EXPECT_NEAR(std::asin(-forward.y) * 180 / std::acos(-1.0), 25.0, 0.1);
  EXPECT_NEAR(std::atan2(-forward.x, -forward.z) * 180 / std::acos(-1.0), 30.0, 0.1);
}

TEST(Stage, AFlatModelIsNotSeenFromItsEdge) {
  test::Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Vec3d normal = random.direction();
    const World world = alone(plane(normal, 1.0, random.uniform(0.1, 10.0)));
    EXPECT_GT(std::fabs(dot(world.camera.forward, normal)), 0.4) << i;
    EXPECT_LT(std::fabs(world.camera.forward.y), 0.95) << "it would lose what is up";
  }
}

TEST(Stage, WhatLiesIsSeenFromAboveAndWhatStandsFromItsFront) {
  for (const Vec3d& normal : {Vec3d{0, 1, 0}, Vec3d{0, -1, 0}, Vec3d{0.3, -0.9, 0.3}})
    EXPECT_LT(alone(plane(normalize(normal), 2, 1)).camera.forward.y, -0.4);
  for (const Vec3d& normal : {Vec3d{1, 0, 0}, Vec3d{-1, 0, 0}, Vec3d{0, 0, 1}, Vec3d{0, 0, -1}})
    EXPECT_LT(dot(alone(plane(normal, 2, 1)).camera.forward, normal), -0.5);
}

TEST(Stage, WhatTheUserSaysOfTheCameraStands) {
  const std::string model = box({0, 0, 0}, {1, 1, 1});
  const World narrow = alone(model, {"camera.fov=10"});
  EXPECT_EQ(narrow.camera.fov, 10.0);
  EXPECT_GT(filled(narrow), 0.75);
  EXPECT_LT(filled(narrow), 0.97);
  const World placed = alone(model, {"camera.position=[9, 0.5, 0.5]"});
  EXPECT_EQ(placed.camera.position, (Vec3d{9, 0.5, 0.5}));
  const World flat = alone(model, {"camera.type=\"orthographic\""});
  EXPECT_GT(flat.camera.size, 1.0);
  EXPECT_LT(flat.camera.size, 2.0);
  EXPECT_EQ(alone(model, {"shading.ambient=[0, 0, 0]"}).appearance.limits.ambient, Rgb{});
}

TEST(Stage, ItsLampsAreNamedAndTheUserIsTold) {
  const World world = alone(box({0, 0, 0}, {1, 1, 1}));
  EXPECT_EQ(world.appearance.light_names, (std::vector<std::string>{"key light", "fill light"}));
  ASSERT_FALSE(world.remarks.empty());
  EXPECT_NE(world.remarks.back().find("25 degrees above"), std::string::npos);
  EXPECT_NE(world.remarks.back().find("key light"), std::string::npos);
}

TEST(Stage, AMeshInASceneHasNone) {
  const Folder folder;
  folder.write("model.obj", box({0, 0, 0}, {1, 1, 1}));
  const World world = test::compiled(folder, "[[mesh]]\nfile = \"model.obj\"\n");
  EXPECT_TRUE(world.appearance.lights.empty());
  EXPECT_TRUE(world.remarks.empty());
  EXPECT_EQ(world.camera.forward, (Vec3d{0, 0, -1}));
  EXPECT_EQ(world.appearance.limits.ambient, (Rgb{0.05, 0.05, 0.05}));
}

TEST(Stage, AModelThatCannotBeReadHasNoOtherFaultThanItsOwn) {
  for (const char* settings : {"film.width=9", "camera.fov=20"}) try {
      (void)alone("o broken\nv 0 0 0\nf 1 1 2\n", {settings});
      ADD_FAILURE() << "it was taken";
    } catch (const SceneError& error) {
      EXPECT_EQ(error.faults().size(), 1u) << settings;
    }
}

TEST(Stage, SmoothIsAKeyOfAnyMesh) {
  const Folder folder;
  folder.write("bent.obj",
               "v -1 0 1\nv 0 0 1\nv 0 0 0\nv -1 0 0\nv 1 -0.4 1\nv 1 -0.4 0\n"
               "f 1 2 3 4\nf 2 5 6 3\n");
  const auto normal_of = [&](const std::string& keys) {
    const World world = test::compiled(folder, "[[mesh]]\nfile = \"bent.obj\"\n" + keys);
    return mesh_of(world).surface_at({0, 0, 0.5}, 0).normal;
  };
  EXPECT_EQ(normal_of(""), (Vec3d{0, 1, 0}));
  EXPECT_LT(normal_of("smooth = 40\n").y, 0.999);
  EXPECT_EQ(normal_of("smooth = 10\n"), (Vec3d{0, 1, 0}));
  EXPECT_EQ(test::faults_of(folder, "[[mesh]]\nfile = \"bent.obj\"\nsmooth = -1\n").size(), 1u);
}

}  // namespace
}  // namespace portalens
