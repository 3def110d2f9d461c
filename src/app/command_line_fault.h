/// \file
/// Mistakes of the command line, in words of ours.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"

namespace portalens {

/// What is wrong with the command line, and what would be right.
[[nodiscard]] Fault fault_of(const CLI::App& program, const CLI::ParseError& error);

/// An option that needs values, before another option or at the end: CLI11 would take the other for
/// its value.
[[nodiscard]] std::optional<Fault> missing_value(const CLI::App& program,
                                                 const std::vector<std::string>& arguments);

}  // namespace portalens
