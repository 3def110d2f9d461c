#include "shading/environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace portalens {

Environment Environment::from(Parameters& parameters, const ImageLoader& load) {
  Environment environment;
  if (parameters.has("image")) {
    environment.image = load(parameters.text("image"), parameters.where("image"));
    environment.rotation = parameters.number("rotation", any_number, 0.0);
    if (parameters.has("color"))
      parameters.fault("color", "the environment has both a color and an image", "keep one");
    return environment;
  }
  const Rgb usual = environment.color;
  environment.color =
      to_vec3(parameters.triple("color", non_negative, Triple{usual.x, usual.y, usual.z}));
  if (parameters.has("rotation"))
    parameters.fault("rotation", "a colour can't be rotated", "remove it, or give an image");
  return environment;
}

Rgb Environment::radiance(Vec3d direction) const {
  if (!image) return color;
  constexpr double pi = std::numbers::pi;
  const double azimuth = std::atan2(direction.x, -direction.z);  // 0 at -z, pi/2 at +x
  const double turned = azimuth / (2.0 * pi) + std::remainder(rotation, 360.0) / 360.0;
  const double height = std::asin(std::clamp(direction.y, -1.0, 1.0)) / pi;
  return bilinear(*image, (0.5 + turned) * image->width, (0.5 - height) * image->height,
                  Rows::clamp);
}

}  // namespace portalens
