/// \file
/// A scene as benchmarks use it: read, changed and compiled, with its camera's photons.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "photon/photon.h"
#include "render/camera_photon.h"
#include "scene/scene.h"
#include "support/arrival_cache.h"
#include "world/world.h"

namespace portalens::benchmarks {

/// "section.key=value", as in TOML.
using Settings = std::vector<std::string>;

struct Subject {
  Scene scene;
  World world;

  /// The scene compiled. @throws SceneError with its faults
  explicit Subject(Scene the_scene);
  /// The same scene with other settings.
  [[nodiscard]] Subject with(const Settings& settings) const;
};

/// A scene file with settings. @throws SceneError with its faults
[[nodiscard]] Subject read_subject(const std::filesystem::path& file, const Settings& settings);
/// A scene that a benchmark wrote: its text is put into `file`, beside what it names.
[[nodiscard]] Subject generated_subject(const std::filesystem::path& file, const std::string& toml);

/// A film of side² pixels with a single sample each.
[[nodiscard]] Settings square_film(int side);

/// One pixel of every n × n: some pixel, so that no pattern of the program's hides behind theirs.
/// @param column, row  of the n × n, from the top left
[[nodiscard]] PixelSample sampled_pixel(const World& world, int every, int column, int row);

/// The photons that `render` sends through those pixels, row by row of the n × n. Each has its own
/// sample, from 0.
[[nodiscard]] std::vector<Photon> camera_photons(const World& world, int every = 1);

/// Where the photons arrive if the scalar engine takes such small steps that smaller ones change
/// nothing; kept in the cache.
[[nodiscard]] std::vector<Arrival> converged_arrivals(const Subject& subject,
                                                      const std::vector<Photon>& photons,
                                                      const ArrivalCache& cache);

/// Everything that decides where the scalar engine's photons arrive, but the photons: the program's
/// sources, the processor's kind, the scene and its files.
[[nodiscard]] std::string recipe_of(const Subject& subject);

}  // namespace portalens::benchmarks
