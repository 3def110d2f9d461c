#include "support/subject.h"

#include <fmt/format.h>

#include <utility>

#include "io/files.h"
#include "io/read_scene.h"
#include "oracle_digest.h"
#include "photon/engine.h"
#include "render/camera_photon.h"
#include "render/fingerprint.h"
#include "world/compile.h"

namespace portalens::benchmarks {
namespace {

/// At a tenth of it, no photon of benchmarks/scenes moves by more than 1e-4 of a pixel.
constexpr double converged_tolerance = 1e-8;

Scene changed(Scene scene, const Settings& settings) {
  Faults faults;
  for (const std::string& setting : settings) override_value(scene, setting, faults);
  faults.raise();
  return scene;
}

}  // namespace

Subject::Subject(Scene the_scene) : scene(std::move(the_scene)), world(compile(scene)) {}

Subject Subject::with(const Settings& settings) const { return Subject(changed(scene, settings)); }

Subject read_subject(const std::filesystem::path& file, const Settings& settings) {
  return Subject(changed(read_scene(file), settings));
}

Subject generated_subject(const std::filesystem::path& file, const std::string& toml) {
  replace_file(file, toml);
  return read_subject(file, {});
}

Settings square_film(int side) {
  return {fmt::format("film.width={}", side), fmt::format("film.height={}", side),
          "sampler.samples=1"};
}

std::vector<Photon> camera_photons(const World& world, int every) {
  std::vector<Photon> photons;
  for (int y = every / 2; y < world.film.height; y += every)
    for (int x = every / 2; x < world.film.width; x += every) {
      Photon photon = camera_photon(world, {x, y, 0});
      photon.sample = photon.slot = static_cast<std::uint32_t>(photons.size());
      photons.push_back(photon);
    }
  return photons;
}

std::string recipe_of(const Subject& subject) {
  std::string recipe = "sources " PORTALENS_ORACLE_DIGEST "\n";
  RenderOptions scalar;
  scalar.engine = Engine::scalar;
  for (const auto& [name, value] : fingerprint_of(subject.scene, subject.world, scalar))
    if (name != "the program") recipe += name + " = " + value + '\n';
  return recipe;
}

std::vector<Arrival> converged_arrivals(const Subject& subject, const std::vector<Photon>& photons,
                                        const ArrivalCache& cache) {
  const Subject exact = subject.with({"physics.integrator=adaptive", "physics.max_steps=10000000",
                                      fmt::format("physics.tolerance={}", converged_tolerance)});
  return cache.arrivals(recipe_of(exact), photons,
                        [&](std::span<const Photon> from, std::span<Arrival> to) {
                          advance(exact.world.space, from, to, Engine::scalar);
                        });
}

}  // namespace portalens::benchmarks
