/// \file
/// The command line of a benchmark.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <string>

#include "support/arrival_cache.h"
#include "support/table.h"

namespace portalens::benchmarks {

/// What all benchmarks are asked for.
struct Request {
  Style style = Style::text;
  std::filesystem::path folder;  ///< where arrivals and generated scenes are kept

  [[nodiscard]] ArrivalCache cache() const { return ArrivalCache(folder / "arrivals"); }
};

/// A program with --json, --markdown and --cache, and what is added to `options`.
class Command {
 public:
  /// @param about  the question that it answers, in a sentence or two
  explicit Command(const std::string& about);

  [[nodiscard]] CLI::App& options() { return app_; }

  /// Reads the command line and runs the benchmark.
  /// @param run  gives the exit status
  /// @return the program's exit status: that of `run`, or 2 for a fault of the scene or the command
  /// line, or 1 where the work failed; those are told
  int run(int count, char** words, const std::function<int(const Request&)>& run);

 private:
  CLI::App app_;
};

}  // namespace portalens::benchmarks
