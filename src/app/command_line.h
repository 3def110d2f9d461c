/// \file
/// From the words of the command line to the subcommand they name.
#pragma once

#include <string>
#include <vector>

namespace portalens {

/// Runs what the arguments (without the program's name) ask for.
/// @return the exit code
/// @throws SceneError if they ask for nonsense; SceneError, WorkError, std::bad_alloc as the
/// subcommands do
[[nodiscard]] int run_command_line(std::vector<std::string> arguments);

}  // namespace portalens
