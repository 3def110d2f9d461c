#include "app/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <iostream>

#include "app/command.h"

namespace portalens {
namespace {

constexpr const char* examples = R"(
Examples:
  portalens render scene.toml                  writes scene.png here
  portalens render scene.toml -o big.exr --width 1920 --height 1080 --samples 64
  portalens render scene.toml --set physics.portal_gravity=shortest-path
  portalens check scene.toml                   what the scene holds, and what is odd about it
  portalens trace scene.toml --ray 0 1 5  0 0 -1 --json
  portalens field scene.toml --plane xz -o field.png
  portalens draw scene.toml --pixel 120 80 --view top    the way of a pixel's photon, drawn

Exit codes: 0 done; 1 the work failed (disk, memory); 2 the scene or the command line has a fault.)";

/// CLI11 2.1 takes "-.5" for an option; "-0.5" it takes for a number.
void spell_out_negative_fractions(std::vector<std::string>& arguments) {
  for (std::string& word : arguments)
    if (word.size() > 2 && word[0] == '-' && word[1] == '.' &&
        std::isdigit(static_cast<unsigned char>(word[2])))
      word.insert(1, "0");
}

}  // namespace

int run_command_line(std::vector<std::string> arguments) {
  CLI::App program("Pictures of scenes whose light bends around masses and goes through portals.",
                   "portalens");
  program.footer(examples);
  program.set_version_flag("--version", "portalens " PORTALENS_VERSION);
  program.require_subcommand(1);
  Command chosen;
  add_render_command(program, chosen);
  add_check_command(program, chosen);
  add_trace_command(program, chosen);
  add_image_command(program, chosen);
  add_field_command(program, chosen);
  add_draw_command(program, chosen);

  spell_out_negative_fractions(arguments);
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
  try {
    program.parse(std::move(arguments));
  } catch (const CLI::ParseError& error) {
    const bool asked = error.get_exit_code() == 0;  // --help, --version
    program.exit(error, std::cout, std::cerr);
    return asked ? exit_done : exit_users_fault;
  }
  return chosen();
}

}  // namespace portalens
