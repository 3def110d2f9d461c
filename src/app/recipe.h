/// \file
/// How a picture was made, kept in its own file, so that it can be made again from that alone.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/image.h"
#include "io/paths.h"
#include "render/render.h"
#include "scene/scene.h"

namespace portalens {

/// The scene as it was read, what was changed in it, and the options that decide what is seen. It
/// says nothing of threads, tiles and folders: a picture does not depend on them.
struct Recipe {
  std::string program;                ///< the version of portalens
  std::string scene_name;             ///< of the scene's file, without its folder
  std::string scene_digest;           ///< of the file's bytes
  std::optional<std::string> text;    ///< those bytes; none of a long file
  std::vector<UsedFile> files;        ///< that the scene names, relative to its folder
  std::vector<std::string> settings;  ///< as --set takes them, in order
  Engine engine = Engine::automatic;
  Photons photons = Photons::fewer;
  std::vector<std::string> layers;  ///< by name
  std::optional<Window> window;     ///< the part of the picture, if not all
};

/// The entry of a picture's header that keeps a recipe: JSON, in it the scene's text packed by zlib
/// and spelled in hexadecimal. The window is left out: the header tells it by itself. Nothing where
/// a name is no UTF-8, or all of it would be longer than 4 MiB.
[[nodiscard]] Metadata recipe_metadata(const Recipe& recipe);

/// A header without one.
[[nodiscard]] Metadata without_recipe(Metadata header);

/// The recipe that a picture keeps. Nobody vouches for what it says.
/// @throws SceneError if the file is no EXR, keeps none, or one that is damaged
[[nodiscard]] Recipe read_recipe(const std::filesystem::path& picture);

/// Adds a fault for each file that the recipe names and that is not in the scene's folder.
void check_files_exist(const Recipe& recipe, const std::filesystem::path& picture,
                       const std::filesystem::path& scene_file, Containment containment,
                       Faults& faults);

/// Adds a fault for each file that is another now than when the picture was made.
void check_files_same(const Recipe& recipe, const std::filesystem::path& picture,
                      const std::vector<UsedFile>& files, Faults& faults);

}  // namespace portalens
