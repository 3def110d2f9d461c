/// \file
/// Reading a scene: TOML, or the paper's OBJ dialect, by the suffix.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "scene/scene.h"

namespace portalens {

/// The longest text that is kept beside the scene that it describes.
inline constexpr std::size_t max_kept_text = std::size_t{1} << 20;

/// What is wrong with single statements or tables is left in `Scene::faults`, for `compile` to tell
/// together with what it finds.
/// @throws SceneError if the file can't be read, or if nothing after the fault could be
[[nodiscard]] Scene read_scene(const std::filesystem::path& file);

/// The same of TOML that lies in memory.
/// @param file  how messages call it; in its folder the scene's files are sought
[[nodiscard]] Scene read_scene_text(std::string_view text, const std::filesystem::path& file);

/// As `read_scene` would read a file of that name if it had this text.
[[nodiscard]] Scene read_kept_text(std::string_view text, const std::filesystem::path& file);

/// A scene without anything in it: every section has its name and place.
[[nodiscard]] Scene empty_scene(const std::filesystem::path& file);

}  // namespace portalens
