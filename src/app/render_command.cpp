/// \file
/// `portalens render`: from a scene to a picture.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "app/command.h"
#include "app/interrupt.h"
#include "app/progress_bar.h"
#include "app/report.h"
#include "app/scene_options.h"
#include "io/image.h"
#include "io/read_scene.h"
#include "render/render.h"

namespace portalens {
namespace {

struct RenderArguments {
  SceneOptions scene;
  std::optional<std::filesystem::path> output;
  std::vector<std::pair<std::string, std::string>> overrides;  ///< key and value of --width, ...
  std::vector<int> crop;
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

std::vector<Channel> channels_of(const Image& image) {
  std::vector<Channel> channels = {{"R", {}}, {"G", {}}, {"B", {}}};
  for (int channel = 0; channel < 3; ++channel) {
    std::vector<float>& values = channels[channel].values;
    values.reserve(image.pixels.size() / 3);
    for (std::size_t i = channel; i < image.pixels.size(); i += 3)
      values.push_back(image.pixels[i]);
  }
  return channels;
}

RenderResult take_picture(const World& world, const RenderArguments& arguments) {
  RenderOptions options = arguments.options;
  if (!arguments.crop.empty()) options.crop = checked_crop(arguments.crop, world.film);
  const InterruptRequest interrupt;
  std::optional<ProgressBar> bar;
  if (!arguments.quiet && errors_go_to_a_terminal()) bar.emplace();
  return render(world, options, bar ? &*bar : nullptr, &interrupt);
}

void tell(const World& world, const RenderResult& result, const std::filesystem::path& picture,
          const RenderArguments& arguments) {
  if (arguments.json) {
    std::cout << json_line(statistics_json(world, result, picture)) << '\n';
  } else if (!arguments.quiet) {
    std::cout << fmt::format("{}: {} x {}, {} samples a pixel, {:.2f} s; {}\n", picture.string(),
                             result.window.width(), result.window.height(), world.sampling.samples,
                             result.seconds, fates_text(result.tally));
    if (arguments.statistics) std::cout << statistics_text(result);
  }
  if (!arguments.quiet) std::cerr << complaint(result.tally);
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
  const World world = compile_with_options(scene, arguments.scene);
  const RenderResult result = take_picture(world, arguments);

  const bool complete = result.completion == Completion::complete;
  if (!complete) {
    if (result.tally.samples == 0) {
      std::cerr << "interrupted before anything stood; nothing is written\n";
      return exit_interrupted;
    }
    picture = unfinished(picture);
    std::cerr << "interrupted; what stands is in " << picture.string() << '\n';
  }
  write_image(picture, result.window.width(), result.window.height(), channels_of(result.image),
              picture_metadata(world, result));
  tell(world, result, picture, arguments);
  return complete ? exit_done : exit_interrupted;
}

/// An option that stands for a value of the scene.
void add_override(CLI::App& command, RenderArguments& arguments, const std::string& option,
                  const std::string& key, const std::string& meaning) {
  command
      .add_option_function<int>(
          option,
          [&arguments, key](const int& value) {
            arguments.overrides.emplace_back(key, std::to_string(value));
          },
          meaning + " (" + key + ")")
      ->check(CLI::PositiveNumber);
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
      .add_option("--tile", arguments->options.tile_size,
                  "Pixels along the side of the squares that threads work on")
      ->capture_default_str()
      ->check(CLI::Range(1, 4096));
  command
      .add_option("--engine", arguments->options.engine,
                  "automatic: photons in lanes of floats where the scene allows it; scalar: one by "
                  "one in double, the program's own standard")
      ->transform(
          CLI::CheckedTransformer(std::map<std::string, Engine>{{"automatic", Engine::automatic},
                                                                {"scalar", Engine::scalar}},
                                  CLI::ignore_case))
      ->type_name("automatic|scalar");
  command.add_flag("-q,--quiet", arguments->quiet, "Print nothing but faults");
  command.add_flag("--stats", arguments->statistics, "Print what it took");
  command.add_flag("--json", arguments->json, "Print what it took, as one JSON object");
  command.callback(
      [arguments, &chosen] { chosen = [arguments] { return render_scene(*arguments); }; });
}

}  // namespace portalens
