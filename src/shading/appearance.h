/// \file
/// Everything that decides how things look, once it is known what light has met.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "shading/environment.h"
#include "shading/light.h"
#include "shading/material.h"

namespace portalens {

/// The `[shading]` table, but for `max_crossings`, which is a property of space.
struct ShadingLimits {
  std::uint32_t max_bounces = 8;
  Rgb lost_color{1, 0, 1};
  bool lost_color_given = false;     ///< else what runs out of crossings shows the environment
  std::uint32_t shadow_samples = 1;  ///< for each area light
  Rgb ambient{0.05, 0.05, 0.05};     ///< radiance

  static ShadingLimits from(Parameters& parameters);
};

/// A surface of the scene: `Space::surfaces` and `Appearance::bodies` have the same indices.
struct Body {
  std::string name;
  std::string kind;
  std::uint32_t material = 0;
  std::vector<std::uint32_t> face_materials;  ///< a mesh's own, one a face; or empty
  std::optional<std::uint32_t> mass;          ///< index into `Space::masses`
  double found_area = 0.0;  ///< of the lamp that it is, and that surfaces ask; 0 if it is none

  [[nodiscard]] std::uint32_t material_of(std::uint32_t face) const {
    return face < face_materials.size() ? face_materials[face] : material;
  }
};

struct Appearance {
  std::vector<Body> bodies;
  std::vector<Material> materials;
  std::vector<Light> lights;
  std::vector<std::string> light_names;  ///< one a light
  std::optional<std::size_t> sky_light;  ///< which of them is the environment
  Environment environment;
  ShadingLimits limits;
};

}  // namespace portalens
