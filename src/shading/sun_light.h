/// \file
/// A disc of the sky, infinitely far: `type = "sun"`.
#pragma once

#include <optional>
#include <string_view>

#include "core/parameters.h"
#include "shading/light_sample.h"
#include "shading/sky_disc.h"

namespace portalens {

class SunLight {
 public:
  static constexpr std::string_view name = "sun";
  static constexpr bool is_delta = false;
  static constexpr bool is_distant = true;

  /// Keys direction, intensity, color or temperature; `angle`, across the disc as it is seen,
  /// degrees: of none it is a point; `visible`, where nothing else is seen in its direction.
  static SunLight from(Parameters& parameters);
  [[nodiscard]] LightSample sample(Vec3d x, double u1, double u2) const;
  /// Of the directions that are drawn, per solid angle; infinite where no photon finds it.
  [[nodiscard]] double density(Vec3d direction) const;
  /// W/m², of a surface that faces it.
  [[nodiscard]] Rgb power() const { return irradiance_; }
  [[nodiscard]] Vec3d towards() const { return towards_; }
  /// What is seen of it.
  [[nodiscard]] std::optional<SkyDisc> disc() const;

 private:
  Vec3d towards_;   ///< unit vector from anywhere to its middle
  Rgb irradiance_;  ///< W/m²
  double half_angle_ = 0.0;
  bool visible_ = true;
};

}  // namespace portalens
