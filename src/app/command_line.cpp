#include "app/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <iostream>
#include <memory>

#include "app/command.h"
#include "app/command_line_fault.h"
#include "core/error.h"
#include "portalens/version.h"

namespace portalens {
namespace {

constexpr const char* examples = R"(
Examples:
  portalens render scene.toml           writes scene.png here
  portalens render scene.toml -o big.exr --width 1920 --height 1080 --samples 64
  portalens render scene.toml --set physics.portal_gravity=shortest-path
  portalens render scene.toml --checkpoint 60     may be killed: --resume goes on
  portalens check scene.toml            what the scene holds, and what is odd
  portalens trace scene.toml --ray 0 1 5  0 0 -1 --json
  portalens field scene.toml --plane xz -o field.png
  portalens draw scene.toml --pixel 120 80 --view top
  portalens help render                 all that a command takes

Exit codes: 0 done; 1 the work failed (disk, memory); 2 the scene or the command
line has a fault; 130, 143 ended by INT, TERM: --resume goes on with a render.)";

/// CLI11 2.1 takes "-.5" for an option; "-0.5" it takes for a number.
void spell_out_negative_fractions(std::vector<std::string>& arguments) {
  for (std::string& word : arguments)
    if (word.size() > 2 && word[0] == '-' && word[1] == '.' &&
        std::isdigit(static_cast<unsigned char>(word[2])))
      word.insert(1, "0");
}

/// `help` asks for the same as `--help`, `help render` as `render --help`; a word that is no
/// command stays alone, to be told.
void spell_out_help(const CLI::App& program, std::vector<std::string>& arguments) {
  if (arguments.empty() || arguments.front() != "help") return;
  arguments.erase(arguments.begin());
  const auto commands = program.get_subcommands([](const CLI::App*) { return true; });
  if (arguments.empty() || std::any_of(commands.begin(), commands.end(), [&](const CLI::App* one) {
        return one->get_name() == arguments.front();
      }))
    arguments.emplace_back("--help");
}

/// Who takes the scene from a picture names none. It is asked of CLI11 beforehand, since a word
/// that is required ends the list of an option's values before it.
void ask_for_no_scene(CLI::App& program, const std::vector<std::string>& arguments) {
  const bool from = std::any_of(arguments.begin(), arguments.end(), [](const std::string& word) {
    return word == "--from" || word.starts_with("--from=");
  });
  if (!from) return;
  for (CLI::App* command : program.get_subcommands([](CLI::App*) { return true; }))
    if (CLI::Option* scene = command->get_option_no_throw("scene")) scene->required(false);
}

/// The text in rows of no more characters than that, unless a word is longer.
std::string in_rows(const std::string& text, std::size_t most) {
  std::string rows;
  std::size_t row = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    if (row > 0) rows += row + 1 + (end - begin) > most ? '\n' : ' ';
    row = row > 0 && rows.back() == ' ' ? row + 1 : 0;
    rows.append(text, begin, end - begin);
    row += end - begin;
    begin = end + 1;
  }
  return rows;
}

/// Help that fits a terminal of 80 columns.
class NarrowHelp : public CLI::Formatter {
 public:
  std::string make_option_desc(const CLI::Option* option) const override {
    return in_rows(CLI::Formatter::make_option_desc(option), 80 - get_column_width());
  }
};

}  // namespace

int run_command_line(std::vector<std::string> arguments) {
  CLI::App program("Pictures of scenes whose light bends around masses and goes through portals.",
                   "portalens");
  program.formatter(std::make_shared<NarrowHelp>());
  program.footer(examples);
  program.set_version_flag("--version", "portalens " + std::string(api::version));
  program.require_subcommand(1);
  Command chosen;
  add_render_command(program, chosen);
  add_merge_command(program, chosen);
  add_check_command(program, chosen);
  add_trace_command(program, chosen);
  add_image_command(program, chosen);
  add_field_command(program, chosen);
  add_draw_command(program, chosen);

  spell_out_negative_fractions(arguments);
  spell_out_help(program, arguments);
  ask_for_no_scene(program, arguments);
  if (const auto fault = missing_value(program, arguments)) throw SceneError({*fault});
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
  try {
    program.parse(std::move(arguments));
  } catch (const CLI::ParseError& error) {
    const bool asked = error.get_exit_code() == 0;  // --help, --version
    if (!asked) throw SceneError({fault_of(program, error)});
    program.exit(error, std::cout, std::cerr);
    return exit_done;
  }
  return chosen();
}

}  // namespace portalens
