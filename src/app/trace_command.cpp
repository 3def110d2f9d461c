/// \file
/// `portalens trace`: where single photons go.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <iostream>
#include <memory>
#include <vector>

#include "app/command.h"
#include "app/read_rays.h"
#include "app/scene_options.h"
#include "app/trace_ray.h"
#include "render/parallel.h"

namespace portalens {
namespace {

struct TraceArguments {
  SceneOptions scene;
  std::vector<double> ray;
  std::string rays_file;
  int bounces = 0;
  int threads = 0;
  bool json = false;
  bool path = false;
};

/// Rays traced between two looks at the output, so that a long list shows its answers early.
constexpr std::size_t rays_at_once = 4096;

std::vector<Ray> rays_of(const TraceArguments& arguments) {
  if (!arguments.ray.empty()) {
    std::array<double, 6> numbers{};
    std::copy_n(arguments.ray.begin(), 6, numbers.begin());
    if (const auto ray = ray_of(numbers)) return {*ray};
    throw SceneError({{Location{}, "--ray has a zero direction, or a number that is not finite",
                       "x y z dx dy dz are needed, the direction not zero"}});
  }
  if (arguments.rays_file == "-") return read_rays(std::cin, "standard input");
  std::ifstream file(arguments.rays_file);
  if (!file || std::filesystem::is_directory(arguments.rays_file))
    throw SceneError({{Location{std::make_shared<const std::string>(arguments.rays_file), 0},
                       "can't be read", "--rays needs a file of lines 'x y z dx dy dz'"}});
  return read_rays(file, arguments.rays_file);
}

int trace_rays(const TraceArguments& arguments) {
  const Scene scene = read_with_settings(arguments.scene);
  const World world = compile_with_options(scene, arguments.scene);
  const std::vector<Ray> rays = rays_of(arguments);
  const PathOutput path = arguments.path ? PathOutput::included : PathOutput::omitted;
  const int threads = arguments.threads > 0 ? arguments.threads : available_threads();

  std::vector<std::string> answers;
  for (std::size_t begin = 0; begin < rays.size() && std::cout; begin += rays_at_once) {
    answers.assign(std::min(rays_at_once, rays.size() - begin), std::string{});
    const auto work = [&](std::size_t i) {
      const Ray& ray = rays[begin + i];
      const Trace trace = trace_ray(world, ray.origin, ray.direction, arguments.bounces);
      answers[i] = arguments.json
                       ? json_line(trace_json(world, trace, arguments.bounces, path)) + '\n'
                       : trace_text(world, trace, path);
    };
    parallel_for(answers.size(), threads, work, [] { return false; });
    for (const std::string& answer : answers) std::cout << answer;
  }
  return exit_done;
}

}  // namespace

void add_trace_command(CLI::App& program, Command& chosen) {
  const auto arguments = std::make_shared<TraceArguments>();
  CLI::App& command = *program.add_subcommand("trace", "Follow single photons");
  add_scene_options(command, arguments->scene);
  CLI::Option* ray =
      command.add_option("--ray", arguments->ray, "One photon: where it starts, and its direction")
          ->expected(6)
          ->type_name("X Y Z DX DY DZ");
  CLI::Option* rays =
      command
          .add_option("--rays", arguments->rays_file,
                      "A file with one photon a line, as for --ray; - is standard input")
          ->type_name("FILE")
          ->excludes(ray);
  command
      .add_option("--bounces", arguments->bounces,
                  "Take the first N surfaces for mirrors, and list them; by default a photon ends "
                  "at its first surface")
      ->check(CLI::Range(0, 1000000))
      ->type_name("N");
  command
      .add_option("-t,--threads", arguments->threads,
                  "Threads; by default as many as the machine has")
      ->check(CLI::Range(1, 1024));
  command.add_flag("--path", arguments->path, "Print the points of the way, too");
  command.add_flag("--json", arguments->json, "Print one JSON object a photon, each on its line");
  command.footer(R"(
Examples:
  portalens trace scene.toml --ray 0 1 5  0 0 -1
  portalens trace scene.toml --rays rays.txt --json --path > ways.jsonl)");
  command.callback([arguments, ray, rays, &chosen] {
    if (ray->count() + rays->count() == 0) throw CLI::RequiredError("--ray or --rays");
    chosen = [arguments] { return trace_rays(*arguments); };
  });
}

}  // namespace portalens
