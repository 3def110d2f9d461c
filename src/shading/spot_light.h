/// \file
/// A point that shines into a cone: `type = "spot"`.
#pragma once

#include <string_view>

#include "core/parameters.h"
#include "shading/light_sample.h"

namespace portalens {

/// Towards the cone's edge the intensity falls off as pbrt's spot does (Pharr, Jakob and Humphreys,
/// sec. 12.2): t² (3 - 2t), where t falls evenly in the cosine from 1 at `cos_inner` to 0 at
/// `cos_outer`.
struct SpotLight {
  static constexpr std::string_view name = "spot";
  static constexpr bool is_delta = true;
  Vec3d position, direction;  ///< the latter a unit vector: the way that its light goes
  Rgb intensity;              ///< W/sr along the axis
  double cos_outer = 0.0, cos_inner = 0.0;

  /// Keys position, direction, intensity, color or temperature; `angle`, of the whole cone,
  /// degrees; `blend`, the share of it in which the light falls off.
  static SpotLight from(Parameters& parameters);
  [[nodiscard]] LightSample sample(Vec3d x, double u1, double u2) const;
  [[nodiscard]] Rgb power() const;
};

}  // namespace portalens
