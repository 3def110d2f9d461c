/// \file
/// The options of `portalens render`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/scene_options.h"
#include "render/render.h"

namespace portalens {

struct RenderArguments {
  SceneOptions scene;
  std::optional<std::filesystem::path> output;
  std::vector<std::pair<std::string, std::string>> overrides;  ///< key and value of --width, ...
  std::vector<int> crop;
  std::optional<std::uint32_t> samples_from, samples_to;
  std::vector<std::string> layers;
  std::optional<std::string> display_server;
  std::optional<double> checkpoint;  ///< seconds between two
  bool resume = false, restart = false;
  RenderOptions options;  ///< of which the threads and the tiles are asked for
  std::optional<Engine> engine;
  std::optional<Photons> photons;
  bool quiet = false, statistics = false, json = false;
};

/// @param arguments  gets what the command line says; must outlive the command
void add_render_options(CLI::App& command, RenderArguments& arguments);

/// `--crop`, for whatever command has it.
void add_crop_option(CLI::App& command, std::vector<int>& crop, const std::string& meaning);

/// The window that --crop asks for.
/// @throws SceneError if it is no part of the film
[[nodiscard]] Window checked_crop(const std::vector<int>& crop, const Window& film);

/// Where only one side of the picture is given, adds the other to the overrides: the picture keeps
/// the shape that it has in the scene.
void keep_shape(RenderArguments& arguments, const Scene& scene);

/// Where the option stands that changes a value, for messages: `--width` for film.width.
[[nodiscard]] Location place_of_override(const std::string& key);

/// What the arguments ask of a world, and what they leave open as the picture has it that the scene
/// came from.
/// @param picture  the file to be written
/// @throws SceneError if the world's picture has no such part
[[nodiscard]] RenderOptions asked_options(const RenderArguments& arguments, const AskedScene& asked,
                                          const World& world, const std::filesystem::path& picture);

/// How the picture is made.
[[nodiscard]] Recipe recipe_of(const RenderArguments& arguments, const AskedScene& asked,
                               const World& world, const RenderOptions& options);

/// The scene with everything that was changed in it, to be put after `portalens trace`.
[[nodiscard]] std::string scene_words(const RenderArguments& arguments);

}  // namespace portalens
