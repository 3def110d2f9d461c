/// \file
/// Finds that are kept as scene files, each with the photon that went wrong.
#pragma once

#include <filesystem>

#include "differential/compare.h"

namespace portalens::differential {

/// A scene file as `--minimise --save` writes it: its last line of comment is the command that
/// traces the photon.
struct KeptFind {
  std::filesystem::path file;
  Photon photon;
  bool open = false;       ///< it has a line `# open`: nobody has mended it yet
  double tolerances = 10;  ///< to which it is followed; another number in a line `# within 1`
};

/// @throws std::runtime_error if the file names no photon
[[nodiscard]] KeptFind read_find(const std::filesystem::path& file);

/// How wrong the photon is by an engine today.
[[nodiscard]] Difference difference_of(const KeptFind& find, Engine engine);

}  // namespace portalens::differential
