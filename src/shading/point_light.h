/// \file
/// A light that is a point: `type = "point"`, and what a [[light]] is that has no type.
#pragma once

#include <numbers>
#include <string_view>

#include "core/parameters.h"
#include "geometry/extent.h"
#include "shading/lamp_input.h"
#include "shading/light_sample.h"

namespace portalens {

/// Keys position, intensity, color or temperature.
struct PointLight {
  static constexpr std::string_view name = "point";
  static constexpr bool is_delta = true;
  Vec3d position;
  Rgb intensity;  ///< W/sr

  static PointLight from(Parameters& parameters) {
    const Vec3d position = to_vec3(parameters.triple("position", coordinate));
    return {position, lamp_intensity(parameters)};
  }
  [[nodiscard]] LightSample sample(Vec3d x, double /*u1*/, double /*u2*/) const {
    const Vec3d way = position - x;
    const double square = dot(way, way);
    return {position, square > 0.0 ? intensity / square : Rgb{}};
  }
  [[nodiscard]] Rgb power() const { return intensity * (4.0 * std::numbers::pi); }
};

}  // namespace portalens
