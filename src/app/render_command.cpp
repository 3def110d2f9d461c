/// \file
/// `portalens render`: from a scene to a picture.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "app/choices.h"
#include "app/command.h"
#include "app/display_server.h"
#include "app/false_color.h"
#include "app/interrupt.h"
#include "app/machine_memory.h"
#include "app/progress_bar.h"
#include "app/report.h"
#include "app/scene_options.h"
#include "app/shell_word.h"
#include "io/image.h"
#include "io/read_scene.h"
#include "render/layers.h"
#include "render/parallel.h"
#include "render/render.h"

namespace portalens {
namespace {

struct RenderArguments {
  SceneOptions scene;
  std::optional<std::filesystem::path> output;
  std::vector<std::pair<std::string, std::string>> overrides;  ///< key and value of --width, ...
  std::vector<int> crop;
  std::vector<std::string> layers;
  std::optional<std::string> display_server;
  RenderOptions options;
  bool quiet = false, statistics = false, json = false;
};

/// The window that --crop asks for.
Window checked_crop(const std::vector<int>& crop, const Film& film) {
  const Window window{crop[0], crop[1], crop[2], crop[3]};
  const bool inside = window.x0 >= 0 && window.y0 >= 0 && window.x0 < window.x1 &&
                      window.y0 < window.y1 && window.x1 <= film.width && window.y1 <= film.height;
  if (!inside)
    throw SceneError({{Location{},
                       fmt::format("--crop {} {} {} {} is no part of the picture", crop[0], crop[1],
                                   crop[2], crop[3]),
                       fmt::format("0 <= X0 < X1 <= {} and 0 <= Y0 < Y1 <= {} are needed",
                                   film.width, film.height)}});
  return window;
}

/// Where the part of a picture goes that stood when the user interrupted: never over a whole one.
std::filesystem::path unfinished(const std::filesystem::path& picture) {
  std::filesystem::path name = picture.stem();
  name += ".unfinished";
  name += picture.extension();
  return picture.parent_path() / name;
}

/// The layers that --layers asks for, each once, in the order of `Layer`.
std::vector<Layer> asked_layers(const std::vector<std::string>& names) {
  std::vector<Layer> layers;
  for (int i = 0; i < layer_count; ++i)
    if (std::any_of(names.begin(), names.end(),
                    [&](const std::string& name) { return name == layer_names[i]; }))
      layers.push_back(static_cast<Layer>(i));
  return layers;
}

/// All who want to know how far the picture is.
class Watchers : public Progress {
 public:
  Watchers(const RenderArguments& arguments, const std::filesystem::path& picture,
           const Window& window) {
    if (arguments.display_server)
      server_.emplace(display_address(*arguments.display_server), picture.string(), window);
    if (!arguments.quiet && errors_go_to_a_terminal()) bar_.emplace();
  }
  void advanced(std::size_t done, std::size_t total, const Tally& tally) override {
    if (bar_) bar_->advanced(done, total, tally);
  }
  void tile_taken(const Window& tile, const Image& film, const Window& window) override {
    if (server_) server_->tile_taken(tile, film, window);
  }
  [[nodiscard]] bool server_went_away() const { return server_ && !server_->connected(); }

 private:
  std::optional<DisplayServer> server_;
  std::optional<ProgressBar> bar_;
};

/// A picture with its layers.
struct Taken {
  RenderResult result;
  std::vector<Channel> channels;
};

RenderResult take_light(const World& world, const RenderArguments& arguments,
                        const RenderOptions& options, const std::filesystem::path& picture,
                        const Cancellation& interrupt) {
  const Window whole{0, 0, world.film.width, world.film.height};
  Watchers watchers(arguments, picture, options.crop.value_or(whole));
  RenderResult result = render(world, options, &watchers, &interrupt);
  if (watchers.server_went_away() && !arguments.quiet)
    std::cerr << "note: the display server went away; the picture went on without it\n";
  return result;
}

Taken take_picture(const World& world, const RenderArguments& arguments,
                   const std::filesystem::path& picture) {
  RenderOptions options = arguments.options;
  if (!arguments.crop.empty()) options.crop = checked_crop(arguments.crop, world.film);
  const InterruptRequest interrupt;
  Taken taken;
  taken.result = take_light(world, arguments, options, picture, interrupt);
  taken.channels = color_channels(taken.result.image);
  const std::vector<Layer> layers = asked_layers(arguments.layers);
  if (layers.empty() || taken.result.completion == Completion::cancelled) return taken;
  if (auto more =
          take_layers(world, taken.result.window, layers, arguments.options.threads, &interrupt))
    std::move(more->begin(), more->end(), std::back_inserter(taken.channels));
  else
    taken.result.completion = Completion::cancelled;
  return taken;
}

/// The scene with everything that was changed in it, to be put after `portalens trace`.
std::string scene_words(const RenderArguments& arguments) {
  std::string words = shell_word(arguments.scene.file.string());
  for (const std::string& setting : arguments.scene.settings)
    words += " --set " + shell_word(setting);
  for (const auto& [key, value] : arguments.overrides) words += " --set " + key + "=" + value;
  if (arguments.scene.allow_outside_files) words += " --allow-outside-files";
  return words;
}

/// The objects' numbers in the layer `object`, a line each; those of large scenes are cut.
std::string object_list(const World& world) {
  constexpr std::size_t most = 1000;
  const std::vector<std::string> names = object_names(world);
  std::string list;
  for (std::size_t i = 0; i < std::min(most, names.size()); ++i)
    list += fmt::format("{} {}\n", i + 1, names[i]);
  return list;
}

void tell(const World& world, const RenderResult& result, const std::filesystem::path& picture,
          const RenderArguments& arguments) {
  if (arguments.json) {
    std::cout << json_line(statistics_json(world, result, picture)) << '\n';
  } else if (!arguments.quiet) {
    std::cout << fmt::format("{}: {} x {}, {} samples a pixel, {:.2f} s; {}\n", picture.string(),
                             result.window.width(), result.window.height(), world.sampling.samples,
                             result.seconds, fates_text(result.tally));
    if (arguments.statistics) std::cout << statistics_text(result, scene_words(arguments));
  }
  if (!arguments.quiet) std::cerr << complaint(result.tally);
}

/// Refuses a picture that the machine has no memory for, and tells what a large one will take.
void look_at_memory(const World& world, const RenderArguments& arguments) {
  constexpr std::uint64_t large = std::uint64_t{1} << 30;
  const Window window = arguments.crop.empty() ? Window{0, 0, world.film.width, world.film.height}
                                               : checked_crop(arguments.crop, world.film);
  std::size_t channels = 0;
  for (const Layer layer : asked_layers(arguments.layers)) channels += channel_names(layer).size();
  const int threads =
      arguments.options.threads > 0 ? arguments.options.threads : available_threads();
  const MemoryEstimate estimate = estimated_memory(world, window, channels, threads);
  check_memory(estimate);
  if (!arguments.quiet && (arguments.statistics || estimate.total() > large))
    std::cerr << fmt::format("note: this takes about {} of memory; there are {}\n",
                             memory_text(estimate.total()), memory_text(machine_memory()));
}

int render_scene(const RenderArguments& arguments) {
  Scene scene = read_with_settings(arguments.scene);
  Faults faults;
  for (const auto& [key, value] : arguments.overrides)
    override_value(scene, key + "=" + value, faults);
  faults.raise();

  std::filesystem::path picture =
      arguments.output.value_or(arguments.scene.file.stem().string() + ".png");
  check_writable(picture);
  if (!arguments.layers.empty() && picture.extension() != ".exr")
    throw SceneError({{Location{}, "--layers: " + picture.string() + " can't hold layers",
                       "name an .exr file with -o"}});
  const World world = compile_with_options(scene, arguments.scene);
  look_at_memory(world, arguments);
  const Taken taken = take_picture(world, arguments, picture);
  const RenderResult& result = taken.result;

  const bool complete = result.completion == Completion::complete;
  if (!complete) {
    if (result.tally.samples == 0) {
      std::cerr << "interrupted before anything stood; nothing is written\n";
      return exit_interrupted;
    }
    picture = unfinished(picture);
    std::cerr << "interrupted; what stands is in " << picture.string() << '\n';
  }
  Metadata metadata = picture_metadata(world, result);
  if (!arguments.layers.empty()) metadata.emplace_back("portalens:objects", object_list(world));
  write_image(picture, result.window.width(), result.window.height(), taken.channels, metadata);
  tell(world, result, picture, arguments);
  return complete ? exit_done : exit_interrupted;
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

}  // namespace

void add_render_command(CLI::App& program, Command& chosen) {
  const auto arguments = std::make_shared<RenderArguments>();
  CLI::App& command = *program.add_subcommand("render", "Take the picture of a scene");
  add_scene_options(command, arguments->scene);
  command
      .add_option("-o,--output", arguments->output,
                  "Picture to write: .png, or .exr (linear, with all the settings); by default the "
                  "scene's name with .png, in the current folder")
      ->type_name("FILE");
  command
      .add_option(
          "-t,--threads", arguments->options.threads,
          "Threads; by default as many as the machine has. The picture does not depend on it")
      ->check(CLI::Range(1, 1024));
  add_override(command, *arguments, "--width", "film.width", "Width of the picture, pixels");
  add_override(command, *arguments, "--height", "film.height", "Height of the picture, pixels");
  add_override(command, *arguments, "--samples", "sampler.samples", "Camera samples a pixel");
  command
      .add_option("--crop", arguments->crop,
                  "Take only the pixels X0 <= x < X1, Y0 <= y < Y1, from the top left")
      ->expected(4)
      ->type_name("X0 Y0 X1 Y1");
  command
      .add_option("--layers", arguments->layers,
                  "Write these, too, beside the picture's R, G, B (an .exr file): " +
                      fmt::format("{}", fmt::join(layer_names, ", ")))
      ->delimiter(',')
      ->check(CLI::IsMember(std::vector<std::string>(layer_names.begin(), layer_names.end())))
      ->type_name("NAME,...");
  command
      .add_option("--display-server", arguments->display_server,
                  "Show the picture in progress in tev, which listens at 127.0.0.1:14158; what is "
                  "left out of HOST:PORT is that")
      ->type_name("HOST:PORT");
  command
      .add_option("--tile", arguments->options.tile_size,
                  "Pixels along the side of the squares that threads work on")
      ->capture_default_str()
      ->check(CLI::Range(1, 4096));
  command
      .add_option("--engine", arguments->options.engine,
                  "automatic: photons in lanes of floats where the scene allows it; scalar: one by "
                  "one in double, the program's own standard")
      ->transform(one_of(std::map<std::string, Engine>{{"automatic", Engine::automatic},
                                                       {"scalar", Engine::scalar}}))
      ->type_name("automatic|scalar");
  command.add_flag("-q,--quiet", arguments->quiet, "Print nothing but faults");
  command.add_flag("--stats", arguments->statistics, "Print what it took");
  command.add_flag("--json", arguments->json, "Print what it took, as one JSON object");
  command.callback(
      [arguments, &chosen] { chosen = [arguments] { return render_scene(*arguments); }; });
}

}  // namespace portalens
