/// \file
/// The photons of a small picture, each on a path of its own and by the sampling grid.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "io/read_scene.h"
#include "lanes/engine.h"
#include "render/camera_photon.h"
#include "render/sampling_grid.h"
#include "support/scene_folder.h"
#include "world/compile.h"

namespace portalens::test {

inline constexpr int side = 128;

inline const std::string small_film =
    fmt::format("[film]\nwidth = {0}\nheight = {0}\n[sampler]\nsamples = 1\n", side);

/// A ground, a hole and a pair of portals through which it pulls.
inline std::string ground_hole_and_portals(const std::string& more = "", int samples = 1) {
  return fmt::format(R"(
[camera]
position = [0.0, 2.5, 13.0]
look_at = [0.0, 1.6, 0.0]
[film]
width = {0}
height = {0}
[sampler]
samples = {1}
[physics]
min_force = 0.2
portal_gravity = "closest-point"
portal_gravity_depth = 1
[[light]]
position = [4, 9, 8]
intensity = [400, 400, 380]
[[quad]]
vertices = [[-30, 0, 30], [30, 0, 30], [30, 0, -30], [-30, 0, -30]]
[[sphere]]
center = [-1.2, 0.6, 2.2]
radius = 0.6
[[mass]]
center = [0.6, 2.7, 1.0]
mass = 150
[[portal]]
name = "orange"
pair = "blue"
vertices = [[-4.6, 0.6, -1.5], [-2.6, 0.6, -1.5], [-2.6, 2.8, -1.5], [-4.6, 2.8, -1.5]]
[[portal]]
name = "blue"
pair = "orange"
vertices = [[2.6, 0.6, -1.5], [4.6, 0.6, -1.5], [4.6, 2.8, -1.5], [2.6, 2.8, -1.5]]
{2}
)",
                     side, samples, more);
}

inline World world_of(const std::string& text) {
  const SceneFolder folder;
  return compile(read_scene(folder.write("scene.toml", text)));
}

struct Found {
  std::vector<Arrival> own, interpolated;
  Tally tally;
};

/// All pixels, each by its own photon, and by the sampling grid.
inline Found found_in(const World& world) {
  std::vector<Photon> photons;
  std::vector<FilmPlace> places;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      photons.push_back(camera_photon(world, {x, y, 0}));
      places.push_back({x + 0.5, y + 0.5});
    }
  Found found;
  found.own.resize(photons.size());
  found.interpolated.resize(photons.size());
  advance(world.space, photons, found.own);
  const auto guard = BeamGuard::over(world.space);
  SamplingGrid(world, *guard, {0, 0, side, side}).advance(places, found.interpolated, found.tally);
  return found;
}

}  // namespace portalens::test
