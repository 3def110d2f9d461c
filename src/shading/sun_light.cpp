#include "shading/sun_light.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "shading/lamp_input.h"

namespace portalens {

SunLight SunLight::from(Parameters& parameters) {
  constexpr double radians = std::numbers::pi / 180.0;
  constexpr Bounds across{0.0, 180.0, false};
  SunLight light;
  light.towards_ = -lamp_direction(parameters);
  light.irradiance_ = lamp_intensity(parameters);
  light.half_angle_ = 0.5 * radians * parameters.number("angle", across, 0.53);
  light.visible_ = parameters.boolean("visible", true);
  return light;
}

/// Of its disc, evenly by solid angle.
LightSample SunLight::sample(Vec3d /*x*/, double u1, double u2) const {
  const double half_sine = std::sin(0.5 * half_angle_);
  const double below = u1 * 2.0 * half_sine * half_sine;  // 1 - cosine from its middle
  const double cosine = 1.0 - below, sine = std::sqrt(below * (1.0 + cosine));
  const double around = 2.0 * std::numbers::pi * u2;
  const Vec3d right = any_perpendicular(towards_), up = cross(towards_, right);
  LightSample sample;
  sample.position =
      right * (sine * std::cos(around)) + up * (sine * std::sin(around)) + towards_ * cosine;
  sample.distant = true;
  // Over the disc the cosine at a surface that faces it has the mean (1 + cos) / 2.
  sample.facing = irradiance_ * (2.0 / (1.0 + std::cos(half_angle_)));
  return sample;
}

double SunLight::density(Vec3d /*direction*/) const {
  const auto seen = disc();
  return seen ? seen->density() : std::numeric_limits<double>::infinity();
}

std::optional<SkyDisc> SunLight::disc() const {
  if (!visible_ || !(half_angle_ > 0.0)) return std::nullopt;
  const double sine = std::sin(half_angle_);
  return SkyDisc{towards_, std::cos(half_angle_), irradiance_ / (std::numbers::pi * sine * sine)};
}

}  // namespace portalens
