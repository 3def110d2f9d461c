/// \file
/// How a surface answers light. equations.md, sec. 7.
#pragma once

#include <string>

#include "shading/texture.h"

namespace portalens {

struct Material {
  std::string name;
  Texture diffuse = Constant{};  ///< reflectance ρ of Lambert's law
  Rgb reflective;                ///< share of the mirrored radiance
  double roughness = 0.0;        ///< GGX with α = roughness²; 0: an exact mirror
  Rgb emitted;                   ///< radiance, on both sides

  /// A `[[material]]` table, but for its name.
  static Material from(Parameters& parameters, const ImageLoader& load);
  [[nodiscard]] bool emits() const { return max_component(emitted) > 0.0; }
};

}  // namespace portalens
