/// \file
/// A small scene with something of everything: a mass, a portal pair, a rough mirror, two lights, a
/// checker, photons that are lost.
#pragma once

namespace portalens::test {

inline constexpr const char* busy_scene = R"(
[camera]
type = "perspective"
position = [0.0, 1.5, 6.0]
look_at = [0.0, 1.0, 0.0]
fov = 50.0
[film]
width = 53
height = 29
[sampler]
samples = 3
seed = 5
[physics]
portal_gravity = "closest-point"
min_force = 4.0
tolerance = 1e-3
max_steps = 16
[environment]
color = [0.2, 0.3, 0.5]
[[material]]
name = "floor"
diffuse = { checker = [[0.8, 0.8, 0.8], [0.1, 0.2, 0.1]], size = 0.5 }
reflective = [0.2, 0.2, 0.2]
roughness = 0.4
[[material]]
name = "red"
diffuse = [0.7, 0.1, 0.1]
[[material]]
name = "lamp"
emitted = [4.0, 4.0, 3.0]
[[quad]]
name = "ground"
vertices = [[-8, 0, 8], [8, 0, 8], [8, 0, -8], [-8, 0, -8]]
material = "floor"
[[quad]]
name = "ceiling"
vertices = [[-1, 4, -1], [1, 4, -1], [1, 4, 1], [-1, 4, 1]]
material = "lamp"
[[sphere]]
name = "ball"
center = [1.2, 0.6, 0.5]
radius = 0.6
material = "red"
[[mass]]
name = "hole"
center = [-0.8, 1.4, 0.0]
mass = 200.0
[[portal]]
name = "blue"
pair = "orange"
vertices = [[-2.5, 0, -1], [-1, 0, -1], [-1, 2, -1], [-2.5, 2, -1]]
tint = [0.8, 0.9, 1.0]
[[portal]]
name = "orange"
pair = "blue"
vertices = [[3, 0, 1.5], [3, 0, 0], [3, 2, 0], [3, 2, 1.5]]
[[light]]
position = [3.0, 5.0, 4.0]
intensity = [20.0, 20.0, 20.0]
)";

}  // namespace portalens::test
