/// \file
/// `portalens field`: how strongly light is pulled, and by what.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "app/choices.h"
#include "app/command.h"
#include "app/drawing.h"
#include "app/field_drawing.h"
#include "app/field_report.h"
#include "app/output.h"
#include "app/scene_options.h"
#include "render/parallel.h"

namespace portalens {
namespace {

struct FieldArguments {
  SceneOptions scene;
  std::vector<double> at, range, rectangle;
  std::string axes;
  std::optional<double> cut;
  std::filesystem::path output;
  FieldDrawingOptions drawing;
  bool json = false;
};

FieldPlane plane_from(const FieldArguments& arguments, const Space& space) {
  if (!arguments.rectangle.empty()) {
    std::array<double, 9> numbers{};
    std::copy_n(arguments.rectangle.begin(), 9, numbers.begin());
    return plane_of(numbers);
  }
  std::optional<std::array<double, 4>> range;
  if (!arguments.range.empty())
    range = {arguments.range[0], arguments.range[1], arguments.range[2], arguments.range[3]};
  return plane_along(arguments.axes, arguments.cut, range, space);
}

int draw(const FieldArguments& arguments) {
  check_drawable(arguments.output);
  const AskedScene asked = read_with_settings(arguments.scene);
  const World world = compile_with_options(asked, arguments.scene);
  check_not_an_input(arguments.output, inputs_of(world, arguments.scene));
  write_drawing(arguments.output,
                draw_field(world.space, plane_from(arguments, world.space), arguments.drawing));
  return exit_done;
}

int tell(const FieldArguments& arguments) {
  const Vec3d x{arguments.at[0], arguments.at[1], arguments.at[2]};
  if (!is_finite(x)) refuse("--at has a number that is not finite", "X Y Z are needed");
  const AskedScene asked = read_with_settings(arguments.scene);
  const World world = compile_with_options(asked, arguments.scene);
  const FieldReport report = report_field(world.space, x);
  std::cout << (arguments.json ? json_line(field_json(world.space, report)) + '\n'
                               : field_text(world.space, report));
  return exit_done;
}

constexpr const char* explanation = R"(
--at tells the acceleration that light feels there, and its parts: each mass directly, and each path
through portals. A path is told by its portals, its length, and
  closest-point, graviton-map  by the nearest point of each face, and where the last one leads to
  shortest-path                by the bends, and where the mass seems to be, all unfolded
  portal-mass                  by the centroid

A drawing shows strength as colour (logarithmic, with its legend), direction as arrows, masses as
discs within the circle of their influence, portals as outlines, thick where the plane cuts them
and with teeth on the front, and in green the paths to the faces: from each dot to what pulls there.

Examples:
  portalens field scene.toml --at 0 1 2 --json
  portalens field scene.toml --plane xz --cut 1.5 -o field.png       from above
  portalens field scene.toml --plane xy --range -4 4 0 5 -o field.svg
  portalens field scene.toml --rectangle 0 0 0  3 0 3  0 4 0 -o tilted.png)";

void add_drawing_options(CLI::App& command, FieldArguments& arguments) {
  command.add_option("-o,--output", arguments.output, "Drawing to write: .png or .svg")
      ->type_name("FILE");
  command
      .add_option("--cut", arguments.cut,
                  "With --plane: the third coordinate; by default the middle of masses and portals")
      ->type_name("NUMBER");
  command
      .add_option("--range", arguments.range,
                  "With --plane: from where to where along the first axis, and along the second; "
                  "by default around masses and portals")
      ->expected(4)
      ->type_name("FROM TO FROM TO");
  command.add_option("--width", arguments.drawing.width, "Width of the drawing, pixels")
      ->capture_default_str()
      ->check(CLI::Range(64, 8192));
  static const std::map<std::string, DrawnWays> kinds = {
      {"none", DrawnWays::none}, {"nearest", DrawnWays::nearest}, {"all", DrawnWays::all}};
  command
      .add_option("--ways", arguments.drawing.ways,
                  "Paths drawn from a point: to the nearest face (the default), to all, or none")
      ->transform(one_of(kinds))
      ->type_name("nearest|all|none");
  arguments.drawing.threads = available_threads();
  command
      .add_option("-t,--threads", arguments.drawing.threads,
                  "Threads; by default as many as the machine has")
      ->check(CLI::Range(1, 1024));
}

}  // namespace

void add_field_command(CLI::App& program, Command& chosen) {
  const auto arguments = std::make_shared<FieldArguments>();
  CLI::App& command = *program.add_subcommand("field", "Tell or draw the field that bends light");
  add_scene_options(command, arguments->scene);
  CLI::Option* at =
      command.add_option("--at", arguments->at, "Tell the field at a point, and its parts")
          ->expected(3)
          ->type_name("X Y Z");
  CLI::Option* plane = command
                           .add_option("--plane", arguments->axes,
                                       "Draw it on a plane along two axes: the first points to "
                                       "the right, the second up, or down in xz, yx and zy: it is "
                                       "seen from where the third one points to")
                           ->type_name("xy|xz|...")
                           ->excludes(at);
  CLI::Option* rectangle =
      command
          .add_option("--rectangle", arguments->rectangle,
                      "Draw it on any rectangle: its lower left corner, its lower side and its "
                      "left side")
          ->expected(9)
          ->type_name("CX CY CZ UX UY UZ VX VY VZ")
          ->excludes(at)
          ->excludes(plane);
  command.add_flag("--json", arguments->json, "With --at: print one JSON object")->needs(at);
  add_drawing_options(command, *arguments);
  for (const char* option : {"--cut", "--range"}) command.get_option(option)->needs(plane);
  command.get_option("--output")->excludes(at);
  command.footer(explanation);
  command.callback([arguments, at, plane, rectangle, &command, &chosen] {
    if (at->count() + plane->count() + rectangle->count() == 0)
      throw CLI::RequiredError("--at, --plane or --rectangle");
    if (at->count() == 0 && command.get_option("--output")->count() == 0)
      throw CLI::RequiredError("--output");
    chosen = [arguments, told = at->count() > 0] {
      return told ? tell(*arguments) : draw(*arguments);
    };
  });
}

}  // namespace portalens
