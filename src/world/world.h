/// \file
/// What a scene compiles to: immutable, ready to ask, safe from any thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "io/development.h"
#include "lanes/planned_space.h"
#include "shading/appearance.h"
#include "world/camera.h"

namespace portalens {

struct Film {
  int width = 960;
  int height = 540;
  Development development;  ///< of a picture to look at
};

struct Sampling {
  std::int64_t samples = 4;
  std::int64_t seed = 0;
};

/// A file that the scene names, relative to the scene's folder, as it was when it was read.
struct UsedFile {
  std::string name, digest;
};

struct World {
  std::filesystem::path file;
  PlannedSpace space;
  Appearance appearance;
  Camera camera;
  Film film;
  Sampling sampling;
  std::vector<UsedFile> files;        ///< by name
  std::vector<std::string> warnings;  ///< what is probably not meant; `check` tells it
  std::vector<std::string> remarks;   ///< what is worth knowing; `check` tells that, too
};

}  // namespace portalens
