#include "app/render_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "app/choices.h"
#include "app/development_options.h"
#include "app/output.h"
#include "app/shell_word.h"
#include "portalens/version.h"
#include "render/layers.h"

namespace portalens {
namespace {

constexpr const char* all_layers = "all";

/// What --layers takes.
std::vector<std::string> layer_words() {
  std::vector<std::string> words(layer_names.begin(), layer_names.end());
  words.emplace_back(all_layers);
  return words;
}

/// An option that stands for a value of the scene.
void add_override(CLI::App& command, RenderArguments& arguments, const std::string& option,
                  const std::string& key, const std::string& meaning) {
  command.add_option_function<int>(
      option,
      [&arguments, key](const int& value) {
        arguments.overrides.emplace_back(key, std::to_string(value));
      },
      meaning + " (" + key + ")");
}

/// Which part of which picture.
void add_picture_options(CLI::App& command, RenderArguments& arguments) {
  command
      .add_option(
          "-o,--output", arguments.output,
          "Picture to write: .png or .jpg, or .exr (linear, with all the settings), or .part "
          "(for portalens merge); by default the scene's name in the current folder, with "
          ".png, or .exr if --layers are asked for")
      ->type_name("FILE");
  add_override(command, arguments, "--width", "film.width",
               "Width of the picture, pixels; if it is given alone, the height follows");
  add_override(command, arguments, "--height", "film.height",
               "Height of the picture, pixels; if it is given alone, the width follows");
  add_override(command, arguments, "--samples", "sampler.samples", "Camera samples a pixel");
  add_development_overrides(command, [&arguments](const char* key, const std::string& value) {
    arguments.overrides.emplace_back(key, value);
  });
  add_crop_option(command, arguments.crop,
                  "Take only the pixels X0 <= x < X1, Y0 <= y < Y1, from the top left");
  command
      .add_option("--samples-from", arguments.samples_from,
                  "Take only the samples A <= sample < B of each pixel (a .part file)")
      ->type_name("A");
  command.add_option("--samples-to", arguments.samples_to, "See --samples-from")->type_name("B");
  command
      .add_option("--layers", arguments.layers,
                  "Write these, too, beside the picture's R, G, B (an .exr file): " +
                      fmt::format("{}", fmt::join(layer_names, ", ")) + "; or all")
      ->delimiter(',')
      ->check(known_word(layer_words()))
      ->type_name("NAME,...");
}

void add_keeping_options(CLI::App& command, RenderArguments& arguments) {
  command
      .add_option("--checkpoint", arguments.checkpoint,
                  "Write what stands to PICTURE.checkpoint so often; it is written, too, when the "
                  "render is ended by INT or TERM, and on USR1")
      ->check(CLI::Range(0.01, 1e9))
      ->type_name("SECONDS");
  CLI::Option* resume =
      command.add_flag("--resume", arguments.resume, "Go on from PICTURE.checkpoint");
  command
      .add_flag("--restart", arguments.restart,
                "Begin anew, and throw away a PICTURE.checkpoint that lies there")
      ->excludes(resume);
}

void add_work_options(CLI::App& command, RenderArguments& arguments) {
  command
      .add_option(
          "-t,--threads", arguments.options.threads,
          "Threads; by default as many as the machine has. The picture does not depend on it")
      ->check(CLI::Range(1, 1024));
  command
      .add_option("--display-server", arguments.display_server,
                  "Show the picture in progress in tev, which listens at 127.0.0.1:14158; what is "
                  "left out of HOST:PORT is that")
      ->type_name("HOST:PORT");
  command
      .add_option("--tile", arguments.options.tile_size,
                  "Pixels along the side of the squares that threads work on; by default 64 where "
                  "few samples are interpolated, else 32")
      ->check(CLI::Range(1, 4096));
  command
      .add_option("--engine", arguments.engine,
                  "automatic: photons in lanes of floats where the scene allows it (check tells "
                  "whether it does, and why not); scalar: one by one in double, the program's own "
                  "standard")
      ->transform(one_of(std::map<std::string, Engine>{{"automatic", Engine::automatic},
                                                       {"scalar", Engine::scalar}}))
      ->type_name("automatic|scalar");
  command
      .add_option("--photons", arguments.photons,
                  "fewer: where neighbouring photons agree, what those between them would find is "
                  "interpolated (in lanes only); all: every sample has a photon of its own")
      ->transform(
          one_of(std::map<std::string, Photons>{{"fewer", Photons::fewer}, {"all", Photons::all}}))
      ->type_name("fewer|all");
}

/// Whether the command line says how long that side of the film is.
bool gives(const RenderArguments& arguments, const std::string& key) {
  const auto& options = arguments.overrides;
  const auto& settings = arguments.scene.settings;
  return std::any_of(options.begin(), options.end(),
                     [&](const auto& option) { return option.first == key; }) ||
         std::any_of(settings.begin(), settings.end(),
                     [&](const std::string& setting) { return setting.rfind(key + "=", 0) == 0; });
}

/// What the scene says of a side of its film; 0 where that is no number of pixels.
std::int64_t side_in(const Scene& scene, const char* key, int otherwise) {
  const Value* value = scene.film.find(key);
  if (!value) return otherwise;
  const auto* number = std::get_if<std::int64_t>(&value->data);
  return number ? std::clamp<std::int64_t>(*number, 0, 1 << 20) : 0;
}

/// The layers that --layers asks for, each once, in the order of `Layer`.
std::vector<Layer> asked_layers(const std::vector<std::string>& names) {
  std::vector<Layer> layers;
  for (int i = 0; i < layer_count; ++i)
    if (std::any_of(names.begin(), names.end(), [&](const std::string& name) {
          return name == all_layers || name == layer_names[i];
        }))
      layers.push_back(static_cast<Layer>(i));
  return layers;
}

SampleRange checked_samples(const RenderArguments& arguments, const World& world) {
  const auto all = static_cast<std::uint32_t>(world.sampling.samples);
  const SampleRange range{arguments.samples_from.value_or(0), arguments.samples_to.value_or(all)};
  if (range.begin >= range.end || range.end > all)
    refuse(fmt::format("--samples-from {} --samples-to {} are no samples of a pixel", range.begin,
                       range.end),
           fmt::format("0 <= A < B <= {} is needed (sampler.samples)", all));
  return range;
}

}  // namespace

void add_crop_option(CLI::App& command, std::vector<int>& crop, const std::string& meaning) {
  command.add_option("--crop", crop, meaning)->expected(4)->type_name("X0 Y0 X1 Y1");
}

void add_render_options(CLI::App& command, RenderArguments& arguments) {
  add_scene_options(command, arguments.scene);
  add_picture_options(command, arguments);
  add_keeping_options(command, arguments);
  add_work_options(command, arguments);
  command.add_flag("-q,--quiet", arguments.quiet, "Print nothing but faults");
  command.add_flag("--stats", arguments.statistics, "Print what it took");
  command.add_flag("--json", arguments.json, "Print what it took, as one JSON object");
}

Window checked_crop(const std::vector<int>& crop, const Window& film) {
  const Window window{crop[0], crop[1], crop[2], crop[3]};
  if (window.empty() || !film.holds(window))
    refuse(fmt::format("--crop {} {} {} {} is no part of the picture", crop[0], crop[1], crop[2],
                       crop[3]),
           fmt::format("0 <= X0 < X1 <= {} and 0 <= Y0 < Y1 <= {} are needed", film.width(),
                       film.height()));
  return window;
}

void keep_shape(RenderArguments& arguments, const Scene& scene) {
  const std::string width = "film.width", height = "film.height";
  const bool by_width = !gives(arguments, height);
  const std::string &given = by_width ? width : height, &other = by_width ? height : width;
  if (gives(arguments, other)) return;
  const std::int64_t w = side_in(scene, "width", Film{}.width);
  const std::int64_t h = side_in(scene, "height", Film{}.height);
  for (const auto& [key, value] : arguments.overrides) {
    if (key != given || w < 1 || h < 1) continue;
    const double ratio = by_width ? static_cast<double>(h) / static_cast<double>(w)
                                  : static_cast<double>(w) / static_cast<double>(h);
    const double side = std::round(std::stod(value) * ratio);
    arguments.overrides.emplace_back(other, fmt::format("{:.0f}", std::max(1.0, side)));
    return;
  }
}

Location place_of_override(const std::string& key) {
  std::string option = "--" + key.substr(key.find('.') + 1);
  std::replace(option.begin(), option.end(), '_', '-');
  return {std::make_shared<const std::string>(std::move(option)), 0};
}

RenderOptions asked_options(const RenderArguments& arguments, const AskedScene& asked,
                            const World& world, const std::filesystem::path& picture) {
  const auto& recipe = asked.recipe;
  RenderOptions options = arguments.options;
  options.engine = arguments.engine.value_or(recipe ? recipe->engine : Engine::automatic);
  options.photons = arguments.photons.value_or(recipe ? recipe->photons : Photons::fewer);
  const Window film{0, 0, world.film.width, world.film.height};
  const bool other_size = gives(arguments, "film.width") || gives(arguments, "film.height");
  if (!arguments.crop.empty())
    options.crop = checked_crop(arguments.crop, film);
  else if (recipe && recipe->window && !other_size && film.holds(*recipe->window))
    options.crop = recipe->window;
  options.samples = checked_samples(arguments, world);
  // A picture to look at is not asked for what it can't hold.
  const bool kept =
      recipe && arguments.layers.empty() && (is_part(picture) || keeps_light(picture));
  options.layers = asked_layers(kept ? recipe->layers : arguments.layers);
  return options;
}

Recipe recipe_of(const RenderArguments& arguments, const AskedScene& asked, const World& world,
                 const RenderOptions& options) {
  Recipe recipe;
  recipe.program = api::version;
  recipe.scene_name = asked.scene.file.filename().string();
  recipe.scene_digest = asked.scene.digest;
  recipe.text = asked.scene.text;
  recipe.files = world.files;
  if (asked.recipe) recipe.settings = asked.recipe->settings;
  const auto& settings = arguments.scene.settings;
  recipe.settings.insert(recipe.settings.end(), settings.begin(), settings.end());
  for (const auto& [key, value] : arguments.overrides) recipe.settings.push_back(key + "=" + value);
  recipe.engine = options.engine;
  recipe.photons = options.photons;
  for (const Layer layer : options.layers)
    recipe.layers.emplace_back(layer_names[static_cast<std::size_t>(layer)]);
  return recipe;
}

std::string scene_words(const RenderArguments& arguments) {
  std::string words = scene_words(arguments.scene);
  for (const auto& [key, value] : arguments.overrides)
    words += " --set " + shell_word(key + "=" + value);
  return words;
}

}  // namespace portalens
