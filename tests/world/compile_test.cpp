#include <gtest/gtest.h>

#include <cmath>

#include "support/scene_text.h"

namespace portalens {
namespace {

using test::compiled;
using test::Folder;

const Texture& diffuse_of(const Material& material) {
  return *std::get<DiffuseMirror>(material.bsdf()).textures()[0];
}

TEST(Compile, AnEmptySceneHasTheDefaultsOfTheFormat) {
  const World world = compiled("[film]\n");
  EXPECT_EQ(world.film.width, 960);
  EXPECT_EQ(world.film.height, 540);
  EXPECT_EQ(world.sampling.samples, 4);
  EXPECT_EQ(world.sampling.seed, 0);
  const Physics& physics = world.space.physics;
  EXPECT_EQ(physics.G, 1.0);
  EXPECT_EQ(physics.c, 45.0);
  EXPECT_EQ(physics.min_force, 0.01);
  EXPECT_EQ(physics.integrator, "adaptive");
  EXPECT_EQ(physics.tolerance, 1e-4);
  EXPECT_EQ(physics.step, 0.02);
  EXPECT_EQ(physics.max_steps, 20000);
  EXPECT_EQ(physics.max_length, 1e6);
  EXPECT_DOUBLE_EQ(physics.max_turning, 8 * std::acos(-1.0));
  EXPECT_EQ(physics.portal_gravity_depth, 1);
  EXPECT_EQ(physics.graviton_resolution, 32);
  EXPECT_EQ(world.space.max_crossings, 64u);
  const ShadingLimits& limits = world.appearance.limits;
  EXPECT_EQ(limits.max_bounces, 8u);
  EXPECT_EQ(limits.lost_color, (Rgb{1, 0, 1}));
  EXPECT_EQ(limits.shadow_samples, 1u);
  EXPECT_EQ(limits.ambient, (Rgb{0.05, 0.05, 0.05}));
  EXPECT_EQ(world.appearance.environment.color, (Rgb{0.2, 0.3, 0.5}));
  EXPECT_TRUE(world.space.surfaces.shapes().empty());
  ASSERT_EQ(world.warnings.size(), 1u);
  EXPECT_NE(world.warnings[0].find("the scene has no object"), std::string::npos);
}

TEST(Compile, WhatTheFileSaysTakesThePlaceOfTheDefaults) {
  const World world = compiled(R"(
[film]
width = 32
height = 16
[sampler]
samples = 9
seed = 77
[physics]
G = 2
c = 3
integrator = "rk4"
step = 0.5
max_steps = 5
[shading]
max_bounces = 0
max_crossings = 3
shadow_samples = 4
lost_color = [0, 1, 0]
[environment]
color = [1, 2, 3]
)");
  EXPECT_EQ(world.film.width, 32);
  EXPECT_EQ(world.sampling.samples, 9);
  EXPECT_EQ(world.sampling.seed, 77);
  EXPECT_EQ(world.space.physics.G, 2.0);
  EXPECT_EQ(world.space.physics.c, 3.0);
  EXPECT_EQ(world.space.physics.integrator, "rk4");
  EXPECT_EQ(world.space.physics.step, 0.5);
  EXPECT_EQ(world.space.physics.max_steps, 5);
  EXPECT_EQ(world.space.max_crossings, 3u);
  EXPECT_EQ(world.appearance.limits.max_bounces, 0u);
  EXPECT_EQ(world.appearance.limits.shadow_samples, 4u);
  EXPECT_EQ(world.appearance.limits.lost_color, (Rgb{0, 1, 0}));
  EXPECT_EQ(world.appearance.environment.color, (Rgb{1, 2, 3}));
}

TEST(Compile, ThingsWithoutANameAreCalledByTheirKindAndIndex) {
  const World world = compiled(R"(
[[sphere]]
center = [0, 0, 0]
radius = 1
[[cube]]
center = [5, 0, 0]
size = 1
[[sphere]]
name = "mine"
center = [0, 3, 0]
radius = 1
[[sphere]]
center = [0, 6, 0]
radius = 1
[[mass]]
center = [0, 0, 90]
mass = 1
)");
  const auto& bodies = world.appearance.bodies;
  ASSERT_EQ(bodies.size(), 4u);
  EXPECT_EQ(bodies[0].name, "sphere0");
  EXPECT_EQ(bodies[1].name, "cube0");
  EXPECT_EQ(bodies[1].kind, "cube");
  EXPECT_EQ(bodies[2].name, "mine");
  EXPECT_EQ(bodies[3].name, "sphere2");
  EXPECT_EQ(world.space.masses[0].name, "mass0");
}

TEST(Compile, MaterialsAreFoundByNameAndGreyIsTheDefault) {
  const World world = compiled(R"(
[[material]]
name = "red"
diffuse = [1, 0, 0]
roughness = 0.5
[[material]]
diffuse = { checker = [[0, 0, 0], [1, 1, 1]], size = 2 }
[[sphere]]
center = [0, 0, 0]
radius = 1
material = "material1"
[[sphere]]
center = [5, 0, 0]
radius = 1
material = "red"
[[sphere]]
center = [9, 0, 0]
radius = 1
)");
  const Appearance& look = world.appearance;
  EXPECT_EQ(look.bodies[0].material, 1u);
  EXPECT_EQ(std::get<Checker>(diffuse_of(look.materials[1])).size, 2.0);
  EXPECT_EQ(look.bodies[1].material, 0u);
  EXPECT_EQ(std::get<DiffuseMirror>(look.materials[0].bsdf()).roughness(), 0.5);
  const Material& plain = look.materials[look.bodies[2].material];
  EXPECT_EQ(std::get<Constant>(diffuse_of(plain)).color, (Rgb{0.5, 0.5, 0.5}));
  EXPECT_FALSE(plain.emits());
}

TEST(Compile, WhatEmitsIsALight) {
  const Folder folder;
  folder.write("two.mtl", "newmtl dark\nKd 1 1 1\nnewmtl bright\nKd 0 0 0\nKe 1 2 3\n");
  folder.write("two.obj",
               "mtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
               "usemtl dark\nf 1 2 3\nusemtl bright\nf 1 2 4\n");
  const World world = compiled(folder, R"(
[[material]]
name = "lamp"
emitted = [4, 5, 6]
[[light]]
position = [0, 9, 0]
intensity = [1, 1, 1]
[[sphere]]
center = [0, 5, 0]
radius = 2
material = "lamp"
[[sphere]]
center = [0, -5, 0]
radius = 1
[[mesh]]
file = "two.obj"
)");
  const auto& lights = world.appearance.lights;
  ASSERT_EQ(lights.size(), 3u);
  EXPECT_EQ(world.appearance.light_names, (std::vector<std::string>{"light0", "sphere0", "mesh0"}));
  EXPECT_EQ(std::get<Constant>(std::get<ShapeLight>(lights[1]).emitted()).color, (Rgb{4, 5, 6}));
  EXPECT_NEAR(std::get<MeshLight>(lights[2]).area(), 0.5, 1e-12);
}

TEST(Compile, AMeshKeepsItsOwnMaterialsUnlessTheSceneGivesItOne) {
  const Folder folder;
  folder.write("m.mtl", "newmtl a\nKd 1 0 0\nnewmtl b\nKd 0 1 0\n");
  folder.write("m.obj",
               "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
               "usemtl b\nf 1 2 3\nusemtl a\nf 1 2 4\n");
  const World world = compiled(folder, R"(
[[material]]
name = "mine"
[[mesh]]
file = "m.obj"
[[mesh]]
file = "m.obj"
material = "mine"
translate = [5, 0, 0]
)");
  const Appearance& look = world.appearance;
  const auto color = [&](std::size_t body, std::uint32_t face) {
    return std::get<Constant>(diffuse_of(look.materials[look.bodies[body].material_of(face)]))
        .color;
  };
  EXPECT_EQ(color(0, 0), (Rgb{0, 1, 0}));
  EXPECT_EQ(color(0, 1), (Rgb{1, 0, 0}));
  EXPECT_EQ(look.bodies[1].material_of(0), 0u);
  EXPECT_EQ(look.bodies[1].material_of(1), 0u);
}

TEST(Compile, MassesHaveTheRadiiOfPhysics) {
  const World world = compiled(R"(
[physics]
G = 2
c = 10
min_force = 0.5
[[sphere]]
center = [1, 2, 3]
radius = 9
mass = 100
[[quad]]
vertices = [[0,0,0], [2,0,0], [2,2,0], [0,2,0]]
mass = 4
center_of_mass = [7, 7, 7]
core_radius = 0.5
[[mass]]
center = [30, 0, 0]
mass = 1
core_radius = 2
horizon = true
[[sphere]]
center = [50, 0, 0]
radius = 1
mass = 0
)");
  const auto& masses = world.space.masses;
  ASSERT_EQ(masses.size(), 3u);
  EXPECT_EQ(masses[0].name, "sphere0");
  EXPECT_EQ(masses[0].center, (Vec3d{1, 2, 3}));
  EXPECT_DOUBLE_EQ(masses[0].gm, 200);
  EXPECT_DOUBLE_EQ(masses[0].horizon_radius, 4);
  EXPECT_DOUBLE_EQ(masses[0].influence, 20);
  EXPECT_TRUE(masses[0].horizon);
  EXPECT_EQ(masses[1].center, (Vec3d{7, 7, 7}));
  EXPECT_EQ(masses[1].core, 0.5);
  EXPECT_FALSE(masses[1].horizon);
  EXPECT_TRUE(masses[2].horizon);
  EXPECT_EQ(world.appearance.bodies[0].mass, 0u);
  EXPECT_EQ(world.appearance.bodies[1].mass, 1u);
  EXPECT_FALSE(world.appearance.bodies[2].mass);
}

TEST(Compile, AMassStandsInTheMiddleOfItsPrimitiveNotInTheOrigin) {
  const World world = compiled(R"(
[[quad]]
vertices = [[10,0,0], [12,0,0], [12,2,0], [10,2,0]]
mass = 1
[[cone]]
base = [20, 0, 0]
height = 4
radius = 1
mass = 1
[[portal]]
pair = "portal1"
vertices = [[30,0,0], [32,0,0], [32,2,0], [30,2,0]]
mass = 1
[[portal]]
pair = "portal0"
vertices = [[40,0,0], [42,0,0], [42,2,0], [40,2,0]]
)");
  const auto& masses = world.space.masses;
  ASSERT_EQ(masses.size(), 3u);
  EXPECT_LT(length(masses[0].center - Vec3d{11, 1, 0}), 1e-12);
  EXPECT_LT(length(masses[1].center - Vec3d{20, 1, 0}), 1e-12);
  EXPECT_LT(length(masses[2].center - Vec3d{31, 1, 0}), 1e-12);
}

TEST(Compile, PortalsKnowTheirPairAndTheWayThrough) {
  const World world = compiled(R"(
[[material]]
name = "wood"
[[portal]]
name = "blue"
pair = "orange"
vertices = [[-1,0,2], [1,0,2], [1,3,2], [-1,3,2]]
tint = [0.5, 0.6, 0.7]
back = "wood"
[[portal]]
name = "orange"
pair = "blue"
vertices = [[10,0,-1], [10,0,1], [10,3,1], [10,3,-1]]
)");
  const auto portals = world.space.portals.portals();
  ASSERT_EQ(portals.size(), 2u);
  EXPECT_EQ(portals[0].pair, 1u);
  EXPECT_EQ(portals[1].pair, 0u);
  EXPECT_EQ(portals[0].tint, (Rgb{0.5, 0.6, 0.7}));
  EXPECT_EQ(portals[0].back_material, 0u);
  EXPECT_FALSE(portals[1].back_material);
  EXPECT_DOUBLE_EQ(portals[0].longest_edge, 3.0);
  EXPECT_NEAR(portals[0].motion()->determinant(), 1.0, 1e-14);
  EXPECT_LT(length(portals[0].motion()->move({-1, 0, 2}) - Vec3d{10, 0, 1}), 1e-12);
  const Vec3d there = portals[0].motion()->move({4, 5, 6});
  EXPECT_LT(length(portals[1].motion()->move(there) - Vec3d{4, 5, 6}), 1e-12);
}

}  // namespace
}  // namespace portalens
