/// \file
/// What the subcommands have in common: each is a function that adds itself to the command line.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace portalens {

/// How the program ends, as scripts see it.
enum ExitCode : int {
  exit_done = 0,
  exit_work_failed = 1,    ///< a disk, a folder, memory
  exit_users_fault = 2,    ///< the scene or the command line
  exit_interrupted = 130,  ///< as shells report an interrupt
};

/// What the user asked for; run after the command line was understood as a whole.
using Command = std::function<int()>;

/// Each adds its subcommand; if the user names it, `chosen` becomes what it does.
void add_render_command(CLI::App& program, Command& chosen);
void add_check_command(CLI::App& program, Command& chosen);
void add_merge_command(CLI::App& program, Command& chosen);
void add_trace_command(CLI::App& program, Command& chosen);
void add_image_command(CLI::App& program, Command& chosen);
void add_field_command(CLI::App& program, Command& chosen);
void add_draw_command(CLI::App& program, Command& chosen);

}  // namespace portalens
