/// \file
/// `portalens trace`: where single photons go.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "app/choices.h"
#include "app/command.h"
#include "app/draw_scene.h"
#include "app/drawing.h"
#include "app/output.h"
#include "app/path_export.h"
#include "app/read_rays.h"
#include "app/scene_options.h"
#include "app/trace_ray.h"
#include "io/files.h"
#include "io/polylines.h"
#include "render/camera_photon.h"
#include "render/cut_turning.h"
#include "render/parallel.h"

namespace portalens {
namespace {

struct TraceArguments {
  SceneOptions scene;
  std::vector<double> rays;  ///< six each
  std::string rays_file;
  std::vector<int> pixels;  ///< x and y in turn
  std::optional<std::uint32_t> sample;
  std::optional<int> bounces;
  int threads = 0;
  bool json = false;
  bool path = false;
  std::filesystem::path output;
  PathColor color = PathColor::fate;
  Standpoint view = Standpoint::top;
};

/// Photons traced between two looks at the output, so that a long list shows its answers early.
constexpr std::size_t photons_at_once = 4096;

std::vector<Ray> rays_of(const TraceArguments& arguments) {
  if (!arguments.rays.empty()) {
    Faults faults;
    std::vector<Ray> rays = rays_in(arguments.rays, faults);
    faults.raise();
    return rays;
  }
  if (arguments.rays_file == "-") return read_rays(std::cin, "standard input");
  std::ifstream file(arguments.rays_file);
  if (!file || std::filesystem::is_directory(arguments.rays_file))
    throw SceneError({{Location{std::make_shared<const std::string>(arguments.rays_file), 0},
                       "can't be read", "--rays needs a file of lines 'x y z dx dy dz'"}});
  return read_rays(file, arguments.rays_file);
}

/// The camera's photons for the pixels that were asked for.
std::vector<Photon> camera_photons(const World& world, const TraceArguments& arguments) {
  Faults faults;
  if (arguments.pixels.size() % 2 != 0)
    faults.add({}, "--pixel has a number too many", "write --pixel X Y, once for each pixel");
  const Film& film = world.film;
  if (arguments.sample && *arguments.sample >= world.sampling.samples)
    faults.add({}, fmt::format("--sample {}: a pixel has no such sample", *arguments.sample),
               fmt::format("0 to {} are there (sampler.samples)", world.sampling.samples - 1));
  std::vector<Photon> photons;
  for (std::size_t i = 0; i + 1 < arguments.pixels.size(); i += 2) {
    const int x = arguments.pixels[i], y = arguments.pixels[i + 1];
    if (x < 0 || y < 0 || x >= film.width || y >= film.height)
      faults.add({}, fmt::format("--pixel {} {} is no pixel of the picture", x, y),
                 fmt::format("0 <= X < {} and 0 <= Y < {} are needed; (0, 0) is top left",
                             film.width, film.height));
    else
      photons.push_back(arguments.sample ? camera_photon(world, {x, y, *arguments.sample})
                                         : central_photon(world, x, y));
  }
  faults.raise();
  return photons;
}

std::vector<Photon> photons_of(const World& world, const TraceArguments& arguments) {
  if (!arguments.pixels.empty()) return camera_photons(world, arguments);
  std::vector<Photon> photons;
  for (const Ray& ray : rays_of(arguments)) {
    Photon& photon = photons.emplace_back();
    photon.position = ray.origin;
    photon.direction = ray.direction;
  }
  return photons;
}

Trace traced(const World& world, const Photon& photon, const TraceArguments& arguments) {
  constexpr int unlimited = std::numeric_limits<int>::max();
  if (!arguments.pixels.empty())
    return trace_pixel(world, photon, arguments.bounces.value_or(unlimited));
  return trace_ray(world, photon, arguments.bounces.value_or(0));
}

/// Where the paths go: into a drawing, or a file of points for other programs.
class WaysFile {
 public:
  /// @throws SceneError if `file` is of another kind; WorkError if it can't be written
  WaysFile(const World& world, const TraceArguments& arguments)
      : world_(world), arguments_(arguments), points_(world, arguments.color) {
    const std::filesystem::path& file = arguments.output;
    if (file == standard_stream)
      refuse("what trace prints goes to standard output, and no file besides",
             "name a file with -o");
    if (!is_drawing_file(file) && !is_path_file(file))
      refuse("can't write " + file.string() + ": its kind is not known",
             "a file of paths ends in .obj, .ply, .gltf or .csv, a drawing of them in "
             ".svg or .png");
    check_replaceable(file);
  }
  void add(std::string name, Trace trace) {
    if (is_drawing_file(arguments_.output))
      drawn_.push_back({std::move(name), std::move(trace)});
    else
      points_.add(trace);
  }
  void write() && {
    const std::filesystem::path& file = arguments_.output;
    if (!is_drawing_file(file)) return write_paths(file, std::move(points_).release());
    DrawingStyle style;
    style.color = arguments_.color;
    StandpointChoice from;
    from.from = arguments_.view;
    write_drawing(file, draw_scene(world_, drawn_, from, style));
  }

 private:
  const World& world_;
  const TraceArguments& arguments_;
  PathExport points_;
  std::vector<DrawnPath> drawn_;
};

/// What a drawing calls a photon.
std::string name_of_photon(const TraceArguments& arguments, std::size_t i) {
  if (arguments.pixels.empty()) return fmt::format("ray {}", i + 1);
  return fmt::format("pixel {} {}", arguments.pixels[2 * i], arguments.pixels[2 * i + 1]);
}

int trace_photons(const TraceArguments& arguments) {
  const AskedScene asked = read_with_settings(arguments.scene);
  const World world = compile_with_options(asked, arguments.scene);
  const std::vector<Photon> photons = photons_of(world, arguments);
  const bool exported = !arguments.output.empty();
  std::optional<WaysFile> ways;
  if (exported) ways.emplace(world, arguments);
  check_not_an_input(arguments.output, inputs_of(world, arguments.scene));
  const EndlessPull endless(world);
  const PathOutput path = arguments.path ? PathOutput::included : PathOutput::omitted;
  const int threads = arguments.threads > 0 ? arguments.threads : available_threads();

  std::vector<std::string> answers;
  std::vector<Trace> traces;
  for (std::size_t begin = 0; begin < photons.size() && std::cout; begin += photons_at_once) {
    answers.assign(std::min(photons_at_once, photons.size() - begin), std::string{});
    traces.assign(exported ? answers.size() : 0, Trace{});
    const auto work = [&](std::size_t i) {
      Trace trace = traced(world, photons[begin + i], arguments);
      const auto missing = endless.missing_turning(trace);
      answers[i] =
          arguments.json
              ? json_line(trace_json(world, trace, missing, arguments.bounces.value_or(0), path)) +
                    '\n'
              : trace_text(world, trace, missing, path);
      if (exported) traces[i] = std::move(trace);
    };
    parallel_for(answers.size(), threads, work, [] { return false; });
    for (const std::string& answer : answers) std::cout << answer;
    for (std::size_t i = 0; i < traces.size(); ++i)
      ways->add(name_of_photon(arguments, begin + i), std::move(traces[i]));
  }
  if (exported) std::move(*ways).write();
  return exit_done;
}

/// Which photons are followed, and how far. One of the options that are given back is required.
std::array<CLI::Option*, 3> add_photon_options(CLI::App& command, TraceArguments& arguments) {
  CLI::Option* ray =
      command
          .add_option("--ray", arguments.rays,
                      "One photon: where it starts, and its direction; may be repeated")
          ->expected(6)
          ->take_all()
          ->allow_extra_args(false)
          ->type_name("X Y Z DX DY DZ");
  CLI::Option* rays =
      command
          .add_option("--rays", arguments.rays_file,
                      "A file with one photon a line, as for --ray; - is standard input")
          ->type_name("FILE")
          ->excludes(ray);
  CLI::Option* pixels =
      command
          .add_option("--pixel", arguments.pixels,
                      "The camera's photon through the centre of a pixel, counted from the top "
                      "left, and on from mirror to mirror as the picture has it; may be repeated")
          ->type_size(2)
          ->type_name("X Y")
          ->excludes(ray)
          ->excludes(rays);
  command
      .add_option("--sample", arguments.sample,
                  "With --pixel: the photon of the picture's sample N, from 0, not the centre's")
      ->needs(pixels)
      ->type_name("N");
  command
      .add_option("--bounces", arguments.bounces,
                  "Take the first N surfaces for mirrors, and list them; by default a photon ends "
                  "at its first surface. With --pixel: follow at most N bounces")
      ->check(CLI::Range(0, 1000000))
      ->type_name("N");
  return {ray, rays, pixels};
}

/// What is told of the paths, and where.
void add_output_options(CLI::App& command, TraceArguments& arguments) {
  command.add_flag("--path", arguments.path, "Print the points of the path, too");
  command.add_flag("--json", arguments.json, "Print one JSON object a photon, each on its line");
  CLI::Option* output =
      command
          .add_option(
              "-o,--output", arguments.output,
              "Write the paths, too: .obj, .ply, .gltf (coloured, with portals and masses), "
              ".csv; or draw them as a plan: .svg, .png")
          ->type_name("FILE");
  command
      .add_option("--color", arguments.color,
                  "Colour the paths by how their photons end, or by how sharply they turn")
      ->transform(one_of(path_color_names()))
      ->needs(output)
      ->type_name("fate|turning");
  command.add_option("--plan", arguments.view, "From where a drawing looks at the scene")
      ->transform(one_of(std::map<std::string, Standpoint>{
          {"top", Standpoint::top}, {"front", Standpoint::front}, {"side", Standpoint::side}}))
      ->needs(output)
      ->type_name("top|front|side");
}

}  // namespace

void add_trace_command(CLI::App& program, Command& chosen) {
  const auto arguments = std::make_shared<TraceArguments>();
  CLI::App& command = *program.add_subcommand(
      "trace", "Follow single photons, by the scalar engine: one by one in double");
  add_scene_options(command, arguments->scene);
  const auto photons = add_photon_options(command, *arguments);
  command
      .add_option("-t,--threads", arguments->threads,
                  "Threads; by default as many as the machine has")
      ->check(CLI::Range(1, 1024));
  add_output_options(command, *arguments);
  command.footer(R"(
Examples:
  portalens trace scene.toml --ray 0 1 5  0 0 -1
  portalens trace scene.toml --pixel 320 180
  portalens trace scene.toml --pixel 320 180 -o path.gltf
  portalens trace scene.toml --rays rays.txt --json --path > paths.jsonl)");
  command.callback([arguments, photons, &chosen] {
    if (photons[0]->count() + photons[1]->count() + photons[2]->count() == 0)
      throw CLI::RequiredError("--ray, --rays or --pixel");
    chosen = [arguments] { return trace_photons(*arguments); };
  });
}

}  // namespace portalens
