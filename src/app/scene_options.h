/// \file
/// The options that say which scene is meant, and what is changed in it for this once.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "world/world.h"

namespace CLI {
class App;
}

namespace portalens {

struct SceneOptions {
  std::filesystem::path file;
  std::vector<std::string> settings;  ///< "section.key=value", in order
  bool allow_outside_files = false;
};

/// SCENE, --set and --allow-outside-files.
void add_scene_options(CLI::App& command, SceneOptions& options);

/// Reads the scene and applies the settings.
/// @throws SceneError
[[nodiscard]] Scene read_with_settings(const SceneOptions& options);

/// @throws SceneError
[[nodiscard]] World compile_with_options(const Scene& scene, const SceneOptions& options);

}  // namespace portalens
