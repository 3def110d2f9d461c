/// \file
/// Mistakes of the command line, in words of ours.
#pragma once

#include <CLI/CLI.hpp>

#include "core/error.h"

namespace portalens {

/// What is wrong with the command line, and what would be right.
[[nodiscard]] Fault fault_of(const CLI::App& program, const CLI::ParseError& error);

}  // namespace portalens
