#include "shading/spot_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/extent.h"
#include "shading/lamp_input.h"

namespace portalens {

SpotLight SpotLight::from(Parameters& parameters) {
  constexpr double radians = std::numbers::pi / 180.0;
  constexpr Bounds cone{0.0, 180.0, true};
  SpotLight light;
  light.position = to_vec3(parameters.triple("position", coordinate));
  light.direction = lamp_direction(parameters);
  light.intensity = lamp_intensity(parameters);
  const double half = 0.5 * radians * parameters.number("angle", cone, 45.0);
  light.cos_outer = std::cos(half);
  light.cos_inner = std::cos(half * (1.0 - parameters.number("blend", unit_interval, 0.15)));
  return light;
}

LightSample SpotLight::sample(Vec3d x, double /*u1*/, double /*u2*/) const {
  const Vec3d way = x - position;
  const double square = dot(way, way);
  if (!(square > 0.0)) return {position, {}};
  const double cosine = dot(way, direction) / std::sqrt(square);
  if (cosine < cos_outer) return {position, {}};
  const double edge = cos_inner - cos_outer;
  const double t = edge > 0.0 ? std::min((cosine - cos_outer) / edge, 1.0) : 1.0;
  return {position, intensity * (t * t * (3.0 - 2.0 * t) / square)};
}

Rgb SpotLight::power() const {
  // Over the edge t² (3 - 2t) has the mean 1/2.
  const double solid_angle =
      2.0 * std::numbers::pi * ((1.0 - cos_inner) + 0.5 * (cos_inner - cos_outer));
  return intensity * solid_angle;
}

}  // namespace portalens
