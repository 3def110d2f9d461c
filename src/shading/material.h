/// \file
/// How a surface looks: what it answers light with, and what it emits. equations.md, sec. 7.
#pragma once

#include <string>
#include <vector>

#include "shading/bsdf.h"
#include "shading/shines.h"
#include "shading/texture.h"

namespace portalens {

class Material {
 public:
  std::string name;

  /// A `[[material]]` table, but for its name.
  static Material from(Parameters& parameters, const ImageLoader& load);
  explicit Material(Bsdf bsdf = {}, Texture emitted = Constant{{}},
                    Shines shines = Shines::on_both_sides);

  [[nodiscard]] const Bsdf& bsdf() const { return bsdf_; }
  /// Radiance, on the sides that shine.
  [[nodiscard]] const Texture& emitted() const { return emitted_; }
  [[nodiscard]] bool emits() const { return emits_; }
  [[nodiscard]] Shines shines() const { return shines_; }
  /// @param direction  of the photon that has met it there
  [[nodiscard]] Rgb emitted_at(const SurfacePoint& point, Vec3d direction) const {
    if (!emits_ || (shines_ == Shines::in_front && !(dot(direction, point.geometric_normal) < 0.0)))
      return {};
    return color_at(emitted_, point);
  }
  /// Whether lamps light it somewhere.
  [[nodiscard]] bool answers_lamps() const;
  [[nodiscard]] std::vector<const Texture*> textures() const;
  /// Whether something of it depends on `u` and `v` on a flat face, too.
  [[nodiscard]] bool uses_coordinates() const { return uses_coordinates_; }

 private:
  Bsdf bsdf_;
  Texture emitted_;
  Shines shines_;
  bool emits_;  ///< somewhere
  bool uses_coordinates_;
};

}  // namespace portalens
