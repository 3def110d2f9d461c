/// \file
/// The options that say which scene is meant, and what is changed in it for this once.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/recipe.h"
#include "scene/scene.h"
#include "world/world.h"

namespace CLI {
class App;
}

namespace portalens {

struct SceneOptions {
  std::filesystem::path file;
  std::optional<std::filesystem::path> from;    ///< the picture to take the scene from
  std::optional<std::filesystem::path> folder;  ///< where that scene's files are
  bool changed_files = false;                   ///< even if they have changed since
  std::vector<std::string> settings;            ///< "section.key=value", in order
  bool allow_outside_files = false;
};

/// SCENE or --from and what belongs to it, --set and --allow-outside-files.
void add_scene_options(CLI::App& command, SceneOptions& options);

/// A scene with its settings, and the recipe of the picture that it came from.
struct AskedScene {
  Scene scene;
  std::optional<Recipe> recipe;
};

/// Reads the scene, from a file, standard input or a picture, and applies the settings: those of
/// the picture, then those of the options.
/// @throws SceneError with what is wrong with the scene's reading, or with all settings
[[nodiscard]] AskedScene read_with_settings(const SceneOptions& options);

/// Warns, too, if another version of the program made the picture that the scene came from.
/// @throws SceneError
[[nodiscard]] World compile_with_options(const AskedScene& asked, const SceneOptions& options);

/// All files that were read for the world.
[[nodiscard]] std::vector<std::filesystem::path> inputs_of(const World& world,
                                                           const SceneOptions& options);

/// What files made from the scene are called by default, without a suffix.
[[nodiscard]] std::string stem_of(const SceneOptions& options);

/// The options again, as words of a command line.
[[nodiscard]] std::string scene_words(const SceneOptions& options);

}  // namespace portalens
