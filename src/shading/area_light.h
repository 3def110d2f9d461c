/// \file
/// Lamps that have an area: `type = "rectangle"`, `"disc"` and `"sphere"`.
#pragma once

#include <optional>
#include <string_view>

#include "core/parameters.h"
#include "geometry/shape.h"
#include "shading/light_sample.h"
#include "shading/shape_light.h"

namespace portalens {

/// Of one radiance on its front, and dark behind.
class AreaLight {
 public:
  static constexpr bool is_delta = false;

  [[nodiscard]] LightSample sample(Vec3d x, double u1, double u2) const {
    return shines_.sample(x, u1, u2);
  }
  [[nodiscard]] Rgb power() const { return shines_.power(); }
  /// What light meets of it: nothing if it is not `visible`.
  [[nodiscard]] std::optional<Shape> body() const {
    return visible_ ? std::optional(shines_.shape()) : std::nullopt;
  }
  /// Of what photons find of it, too: none of what is not seen.
  [[nodiscard]] double found_area() const { return visible_ ? shines_.area() : 0.0; }
  [[nodiscard]] Rgb radiance() const { return brightest(shines_.emitted()); }

 protected:
  AreaLight(Shape shape, Rgb radiance, bool visible)
      : shines_(std::move(shape), Constant{radiance}, Shines::in_front), visible_(visible) {}

 private:
  ShapeLight shines_;
  bool visible_;
};

/// Keys position: of its middle; direction: its light goes to that side; up: along the height;
/// size: width and height, or a number for both; intensity: radiance, and color or temperature;
/// visible.
class RectangleLight : public AreaLight {
 public:
  static constexpr std::string_view name = "rectangle";
  static RectangleLight from(Parameters& parameters);

 private:
  using AreaLight::AreaLight;
};

/// Keys position, direction, radius; intensity: radiance, and color or temperature; visible.
class DiscLight : public AreaLight {
 public:
  static constexpr std::string_view name = "disc";
  static DiscLight from(Parameters& parameters);

 private:
  using AreaLight::AreaLight;
};

/// Keys position, radius; intensity: W/sr, as a point's, and color or temperature; visible.
class SphereLight : public AreaLight {
 public:
  static constexpr std::string_view name = "sphere";
  static SphereLight from(Parameters& parameters);

 private:
  using AreaLight::AreaLight;
};

}  // namespace portalens
