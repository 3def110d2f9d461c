/// \file
/// What a scene compiles to: immutable, ready to ask, safe from any thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "photon/space.h"
#include "shading/environment.h"
#include "shading/light.h"
#include "shading/material.h"
#include "world/camera.h"

namespace portalens {

struct Film {
  int width = 960;
  int height = 540;
};

struct Sampling {
  std::int64_t samples = 4;
  std::int64_t seed = 0;
};

/// The `[shading]` table.
struct ShadingLimits {
  std::uint32_t max_bounces = 8;
  Rgb lost_color{1, 0, 1};
  std::uint32_t shadow_samples = 1;
  Rgb ambient{0.05, 0.05, 0.05};
};

/// A surface of the scene: `Space::surfaces` and this list have the same indices.
struct Body {
  std::string name;
  std::string kind;
  std::uint32_t material = 0;
  std::optional<std::uint32_t> mass;  ///< index into `Space::masses`
};

struct World {
  std::filesystem::path file;
  Space space;
  std::vector<Body> bodies;
  std::vector<Material> materials;
  std::vector<Light> lights;
  Environment environment;
  ShadingLimits shading;
  Camera camera;
  Film film;
  Sampling sampling;
  std::vector<std::string> warnings;  ///< what `check` tells beside the description
};

}  // namespace portalens
