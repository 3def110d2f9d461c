#include "shading/lamp_input.h"

#include "geometry/extent.h"
#include "math/black_body.h"

namespace portalens {

Rgb lamp_intensity(Parameters& parameters) {
  const Rgb intensity = to_vec3(parameters.number_or_triple("intensity", non_negative));
  const Rgb color = to_vec3(parameters.triple("color", non_negative, Triple{1, 1, 1}));
  if (!parameters.has("temperature")) return intensity * color;
  if (parameters.has("color"))
    parameters.fault("temperature", "color and temperature exclude each other",
                     "leave one of them out");
  constexpr Bounds glows{500.0, 1e6, false};
  return intensity * black_body_color(parameters.number("temperature", glows, 6500.0));
}

Vec3d lamp_direction(Parameters& parameters) {
  const Vec3d direction = to_vec3(parameters.triple("direction", coordinate));
  if (length(direction) > 0.0) return normalize(direction);
  parameters.fault("direction", "'direction' has no length",
                   "give the way that its light goes, for instance [0, -1, 0]");
  return {0.0, -1.0, 0.0};
}

}  // namespace portalens
