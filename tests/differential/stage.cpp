#include "differential/stage.h"

#include <fmt/format.h>

#include <algorithm>

#include "differential/random_scene.h"
#include "io/override.h"
#include "io/read_scene.h"
#include "shading/shading_point.h"
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

/// Those that start on surfaces, where the photons of the camera met them.
std::vector<Photon> mirrored_photons(const World& world, const std::vector<Photon>& photons) {
  std::vector<Arrival> arrivals(photons.size());
  advance(world.space, photons, arrivals, Engine::scalar);
  const ShadingPoints points(world.space, world.appearance);
  std::vector<Photon> mirrored;
  for (const Arrival& arrival : arrivals) {
    if (arrival.fate != Fate::hit) continue;
    const ShadingPoint point = points.at(arrival).point;
    const double towards = dot(arrival.direction, point.outward);
    if (towards >= 0.0) continue;
    Photon photon;
    photon.position = point.position;
    photon.direction = normalize(arrival.direction - 2.0 * towards * point.outward);
    photon.guard = point.leaving(photon.direction);
    mirrored.push_back(photon);
  }
  return mirrored;
}

}  // namespace

double reference_tolerance(double tolerance) { return std::min(1e-8, 0.01 * tolerance); }

Stage set_up(const std::filesystem::path& file) {
  World own = compile(read_scene(file));
  Scene scene = read_scene(file);
  Faults faults;
  const double tolerance = reference_tolerance(own.space.physics.tolerance);
  override_value(scene, fmt::format("physics.tolerance={}", tolerance), faults);
  override_value(scene, fmt::format("physics.max_steps={}", reference_steps), faults);
  faults.raise();
  std::vector<Photon> photons = camera_photons(own);
  return {std::move(own), compile(scene), std::move(photons)};
}

Stage set_up(const Draft& draft, const SceneFolder& folder) {
  if (has_mesh(draft)) folder.write(mesh_name, mesh_text());
  Stage stage = set_up(folder.write("scene.toml", to_toml(draft, draft.kind)));
  if (is_room(draft)) {
    const std::vector<Photon> mirrored = mirrored_photons(stage.own, stage.photons);
    stage.photons.insert(stage.photons.end(), mirrored.begin(), mirrored.end());
  }
  return stage;
}

}  // namespace portalens::differential
