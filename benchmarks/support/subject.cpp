#include "support/subject.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "io/files.h"
#include "io/override.h"
#include "io/read_scene.h"
#include "lanes/engine.h"
#include "math/random.h"
#include "oracle_digest.h"
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

PixelSample sampled_pixel(const World& world, int every, int column, int row) {
  const std::uint64_t key =
      combined(combined(0, static_cast<std::uint64_t>(column)), static_cast<std::uint64_t>(row));
  const auto some = [every](std::uint64_t bits, int first, int end) {
    return first + static_cast<int>(bits % static_cast<unsigned>(std::min(every, end - first)));
  };
  return {some(key >> 32, column * every, world.film.width),
          some(key & 0xffffffff, row * every, world.film.height), 0};
}

std::vector<Photon> camera_photons(const World& world, int every) {
  std::vector<Photon> photons;
  for (int row = 0; row * every < world.film.height; ++row)
    for (int column = 0; column * every < world.film.width; ++column) {
      Photon photon = camera_photon(world, sampled_pixel(world, every, column, row));
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
