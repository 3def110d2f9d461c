/// \file
/// `portalens draw`: a scene and photons' paths as a drawing.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <map>
#include <memory>

#include "app/choices.h"
#include "app/command.h"
#include "app/draw_scene.h"
#include "app/output.h"
#include "app/scene_options.h"
#include "render/parallel.h"

namespace portalens {
namespace {

struct DrawArguments {
  SceneOptions scene;
  std::optional<std::filesystem::path> output;
  AskedRays rays;
  std::vector<double> eye, look_at, extent;
  std::optional<double> fov;
  Standpoint view = Standpoint::camera;
  DrawingStyle style;
  bool no_legend = false, quiet = false;
  int bounces = 0, threads = 0;
};

constexpr const char* examples = R"(
Examples:
  portalens draw scene.toml                               the scene alone, as its camera sees it
  portalens draw scene.toml --pixel 12 40 --pixel 200 40 --view top -o ways.svg
  portalens draw scene.toml --pixel 0 0 --bounces 1 --eye 8 5 12 --look-at 0 1 0
  portalens draw scene.toml --view top --fan 0 1 9  0 0 -1  40 15
  portalens draw scene.toml --view side --grid 1 12 --extent -10 0 10 6)";

std::optional<Vec3d> place_of(const std::vector<double>& numbers, const char* option) {
  if (numbers.empty()) return std::nullopt;
  const Vec3d place{numbers[0], numbers[1], numbers[2]};
  for (const double number : numbers)
    if (!(std::fabs(number) <= 1e12))
      refuse(fmt::format("{} has a number that is not finite, or beyond 1e12", option),
             "give X Y Z as lengths of the scene");
  return place;
}

StandpointChoice standpoint_of(const DrawArguments& arguments) {
  StandpointChoice choice;
  choice.from = arguments.view;
  choice.eye = place_of(arguments.eye, "--eye");
  choice.look_at = place_of(arguments.look_at, "--look-at");
  choice.fov = arguments.fov;
  const bool plan = choice.from != Standpoint::camera;
  if (plan && choice.eye)
    refuse("--eye is of no use to a plan", "leave out --eye, or take --view camera");
  if (!choice.eye && (choice.look_at || choice.fov))
    refuse("--look-at and --fov turn a camera that --eye places", "give --eye X Y Z, too");
  if (arguments.extent.empty()) return choice;
  const auto& e = arguments.extent;
  if (!plan) refuse("--extent is of no use to a camera", "take --view top, front or side");
  for (const double number : e)
    if (!(std::fabs(number) <= 1e12)) refuse("--extent has a number beyond 1e12", "give lengths");
  if (!(e[2] - e[0] > 1e-9 && e[3] - e[1] > 1e-9))
    refuse("--extent shows nothing", "A0 < A1 and B0 < B1 are needed, in the order A0 B0 A1 B1");
  choice.extent = {e[0], e[1], e[2], e[3]};
  return choice;
}

/// What a fan is spread at right angles to: in a plan the line of sight, else upwards.
Vec3d fan_axis(Standpoint from) {
  if (from == Standpoint::front) return {0, 0, 1};
  if (from == Standpoint::side) return {1, 0, 0};
  return {0, 1, 0};
}

std::string summary(const std::vector<DrawnPath>& paths) {
  std::array<std::size_t, fate_count> fates{};
  for (const DrawnPath& path : paths) ++fates[static_cast<std::size_t>(path.trace.end.fate)];
  std::string text = fmt::format("{} photon{}", paths.size(), paths.size() == 1 ? "" : "s");
  const char* separator = ": ";
  for (std::size_t i = 0; i < fates.size(); ++i) {
    if (fates[i] == 0) continue;
    text += fmt::format("{}{} {}", separator, fates[i], fate_names[i]);
    separator = ", ";
  }
  return text;
}

int draw(const DrawArguments& arguments) {
  const StandpointChoice choice = standpoint_of(arguments);
  const AskedScene asked = read_with_settings(arguments.scene);
  const std::filesystem::path picture =
      arguments.output.value_or(stem_of(arguments.scene) + "-drawing.png");
  check_drawable(picture);
  const World world = compile_with_options(asked, arguments.scene);
  check_not_an_input(picture, inputs_of(world, arguments.scene));
  const std::vector<NamedRay> rays = rays_of(world, arguments.rays, fan_axis(choice.from));
  const int threads = arguments.threads > 0 ? arguments.threads : available_threads();
  const std::vector<DrawnPath> paths = follow(world, rays, arguments.bounces, threads);
  const Drawing drawing = draw_scene(world, paths, choice, arguments.style);
  write_drawing(picture, drawing);
  if (!arguments.quiet)
    words_beside(picture) << fmt::format("{}: {} x {}; {}\n", picture.string(), drawing.width,
                                         drawing.height, summary(paths));
  return exit_done;
}

void add_ray_options(CLI::App& command, DrawArguments& arguments) {
  AskedRays& rays = arguments.rays;
  command
      .add_option("--pixel", rays.pixels,
                  "The photon through a pixel's centre, from the top left; may be repeated")
      ->expected(2)
      ->take_all()
      ->allow_extra_args(false)
      ->type_name("X Y");
  command.add_option("--ray", rays.rays, "A photon's start and direction; may be repeated")
      ->expected(6)
      ->take_all()
      ->allow_extra_args(false)
      ->type_name("X Y Z DX DY DZ");
  command
      .add_option("--rays", rays.file,
                  "A file with one photon a line, as for --ray; - is standard input")
      ->type_name("FILE");
  command
      .add_option("--fan", rays.fan,
                  "COUNT photons from a point, SPREAD degrees from the first to the last, in the "
                  "plane of a plan, else level")
      ->expected(8)
      ->type_name("OX OY OZ DX DY DZ SPREAD COUNT");
  command.add_option("--grid", rays.grid, "Photons through a grid over the camera's picture")
      ->expected(2)
      ->type_name("NX NY");
  command
      .add_option("--bounces", arguments.bounces,
                  "Take the first N surfaces for mirrors; by default a photon ends at its first")
      ->check(CLI::Range(0, 1000))
      ->type_name("N");
  CLI::Option* color =
      command
          .add_option(
              "--color", arguments.style.color,
              "Colour the paths by how their photons end, or by how sharply they turn, instead "
              "of step by step")
          ->transform(one_of(path_color_names()))
          ->type_name("fate|turning");
  command
      .add_option("--every", arguments.style.steps_a_color,
                  "Change the colour after this many steps")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str()
      ->excludes(color)
      ->type_name("N");
}

void add_view_options(CLI::App& command, DrawArguments& arguments) {
  const std::map<std::string, Standpoint> views = {{"camera", Standpoint::camera},
                                                   {"top", Standpoint::top},
                                                   {"front", Standpoint::front},
                                                   {"side", Standpoint::side}};
  command
      .add_option("--view", arguments.view,
                  "camera (the scene's, the default), or a plan: top (x, z), front (x, y), "
                  "side (z, y)")
      ->transform(one_of(views))
      ->type_name("camera|top|front|side");
  command.add_option("--eye", arguments.eye, "Draw from a camera here instead of the scene's")
      ->expected(3)
      ->type_name("X Y Z");
  command
      .add_option("--look-at", arguments.look_at, "Where that camera looks; by default the middle")
      ->expected(3)
      ->type_name("X Y Z");
  command
      .add_option("--fov", arguments.fov,
                  "Its field of view across the height, degrees; by default all is seen")
      ->check(number_within(0.001, 179.0))
      ->type_name("DEGREES");
  command
      .add_option("--extent", arguments.extent,
                  "What a plan shows: from A0 to A1 on its first axis, B0 to B1 on its second; by "
                  "default all")
      ->expected(4)
      ->type_name("A0 B0 A1 B1");
  command.add_option("--width", arguments.style.size.width, "Width of the drawing, pixels")
      ->check(CLI::Range(16, 4096))
      ->capture_default_str();
  command
      .add_option(
          "--height", arguments.style.size.height,
          "Height of the drawing without its legend, pixels; by default as the film's shape")
      ->check(CLI::Range(16, 4096));
}

}  // namespace

void add_draw_command(CLI::App& program, Command& chosen) {
  const auto arguments = std::make_shared<DrawArguments>();
  CLI::App& command =
      *program.add_subcommand("draw", "Draw a scene and the paths of photons, as SVG or PNG");
  add_scene_options(command, arguments->scene);
  command
      .add_option("-o,--output", arguments->output,
                  "Drawing to write: .svg or .png; by default the scene's name with -drawing.png, "
                  "in the current folder")
      ->type_name("FILE");
  add_ray_options(command, *arguments);
  add_view_options(command, *arguments);
  command.add_flag("--no-legend", arguments->no_legend, "Leave out the strip that explains");
  command
      .add_option("-t,--threads", arguments->threads,
                  "Threads; by default as many as the machine has")
      ->check(CLI::Range(1, 1024));
  command.add_flag("-q,--quiet", arguments->quiet, "Print nothing but faults");
  command.footer(examples);
  command.callback([arguments, &chosen] {
    if (arguments->rays.pixels.size() % 2 != 0)
      throw CLI::ArgumentMismatch("--pixel: two numbers are needed, X Y");
    if (arguments->rays.rays.size() % 6 != 0)
      throw CLI::ArgumentMismatch("--ray: six numbers are needed, X Y Z DX DY DZ");
    arguments->style.legend = !arguments->no_legend;
    chosen = [arguments] { return draw(*arguments); };
  });
}

}  // namespace portalens
