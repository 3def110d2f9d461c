#include "differential/stage.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/read_scene.h"
#include "world/compile.h"

namespace portalens::differential {
namespace {

/// A photon of the reference may take so many steps: six times those of an adaptive integrator of
/// fifth order at 1e-4 are enough, and what winds without end is soon found trapped.
constexpr int reference_steps = 200000;

std::vector<Photon> camera_photons(const World& world) {
  std::vector<Photon> photons;
  const FilmCamera camera(world.camera, world.film.width, world.film.height);
  for (int y = 0; y < world.film.height; ++y)
    for (int x = 0; x < world.film.width; ++x) {
      const Ray ray = camera.ray(x + 0.5, y + 0.5);
      Photon photon;
      photon.position = ray.origin;
      photon.direction = ray.direction;
      photons.push_back(photon);
    }
  return photons;
}

}  // namespace

double reference_tolerance(double tolerance) { return std::min(1e-8, 0.01 * tolerance); }

Stage set_up(const Draft& draft, const SceneFolder& folder) {
  if (has_mesh(draft)) folder.write(mesh_name, mesh_text());
  const auto file = folder.write("scene.toml", to_toml(draft, draft.kind));
  Scene exact = read_scene(file);
  Faults faults;
  override_value(exact, fmt::format("physics.tolerance={}", reference_tolerance(draft.tolerance)),
                 faults);
  override_value(exact, fmt::format("physics.max_steps={}", reference_steps), faults);
  faults.raise();
  World own = compile(read_scene(file));
  std::vector<Photon> photons = camera_photons(own);
  return {std::move(own), compile(exact), std::move(photons)};
}

}  // namespace portalens::differential
