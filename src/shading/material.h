/// \file
/// How a surface looks: what it answers light with, and what it emits. equations.md, sec. 7.
#pragma once

#include <string>
#include <vector>

#include "shading/bsdf.h"
#include "shading/texture.h"

namespace portalens {

class Material {
 public:
  std::string name;

  /// A `[[material]]` table, but for its name.
  static Material from(Parameters& parameters, const ImageLoader& load);
  explicit Material(Bsdf bsdf = {}, Texture emitted = Constant{{}});

  [[nodiscard]] const Bsdf& bsdf() const { return bsdf_; }
  /// Radiance, on both sides.
  [[nodiscard]] const Texture& emitted() const { return emitted_; }
  [[nodiscard]] bool emits() const { return emits_; }
  [[nodiscard]] Rgb emitted_at(const SurfacePoint& point) const {
    return emits_ ? color_at(emitted_, point) : Rgb{};
  }
  /// Whether lamps light it somewhere.
  [[nodiscard]] bool answers_lamps() const;
  [[nodiscard]] std::vector<const Texture*> textures() const;
  /// Whether something of it depends on `u` and `v` on a flat face, too.
  [[nodiscard]] bool uses_coordinates() const { return uses_coordinates_; }

 private:
  Bsdf bsdf_;
  Texture emitted_;
  bool emits_;  ///< somewhere
  bool uses_coordinates_;
};

}  // namespace portalens
