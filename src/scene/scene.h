/// \file
/// A scene as a file describes it: tables of values with their places, nothing interpreted yet.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/parameters.h"

namespace portalens {

/// What stands at a file's top, and is neither a section nor a list of tables.
struct Misplaced {
  enum class Form { key, table, element };  ///< `name = 3`, `[name]`, `name = [3]`
  Form form;
  std::string name;
  Location where;
};

/// What a reader fills and a person could edit. `compile` (world/compile.h) gives it meaning.
struct Scene {
  std::filesystem::path file;
  std::string digest;               ///< of the bytes of that file
  std::optional<std::string> text;  ///< those bytes; a reader keeps none of a long file
  Table camera, film, sampler, physics, shading, environment;
  std::vector<Table> materials;
  std::vector<Table> lights;
  /// Primitives, portals and bare masses, in the order of the file; the kind is the table's.
  std::vector<Table> objects;
  /// A reader knows no kinds of objects: `compile` tells what each of these should be.
  std::vector<Misplaced> misplaced;
  /// No camera in the file: look at the bounding box from +z.
  bool has_camera = false;
  /// What the reader found wrong and could read on after; `compile` adds its own and throws them
  /// all.
  Faults faults;
  /// Things a user should know that are not mistakes; `check` prints them.
  std::vector<std::string> notes;
};

}  // namespace portalens
