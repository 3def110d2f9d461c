/// \file
/// Where the files that a scene names may lie.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/error.h"

namespace portalens {

enum class Containment { scene_folder, anywhere };

/// The file that `name` means, relative to the scene's folder. A fault is added, and nothing
/// returned, if it does not exist, is not a regular file (no device, no FIFO is ever opened), or
/// leaves the folder (through `..`, an absolute path or a link) though it must not.
[[nodiscard]] std::optional<std::filesystem::path> resolve_file(
    const std::filesystem::path& scene_file, const std::string& name, Containment containment,
    const Location& asked_at, Faults& faults);

/// Whether `name` means a place within the scene's folder where there is nothing.
[[nodiscard]] bool is_missing(const std::filesystem::path& scene_file, const std::string& name);

}  // namespace portalens
