#include "shading/environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace portalens {

Environment Environment::from(Parameters& parameters, const ImageLoader& load) {
  Environment environment;
  const double intensity = parameters.number("intensity", non_negative, 1.0);
  const auto color_or = [&](Rgb usual) {
    const Triple given =
        parameters.triple("color", non_negative, Triple{usual.x, usual.y, usual.z});
    return to_vec3(given) * intensity;
  };
  if (parameters.has("image")) {
    environment.image = load(parameters.text("image"), parameters.where("image"));
    environment.rotation = parameters.number("rotation", any_number, 0.0);
    environment.scale = color_or(environment.scale);
    return environment;
  }
  environment.color = color_or(environment.color);
  if (parameters.has("rotation"))
    parameters.fault("rotation", "a colour can't be rotated", "remove it, or give an image");
  return environment;
}

Rgb Environment::radiance(Vec3d direction) const {
  Rgb sum = sky(direction);
  for (const SkyDisc& disc : discs)
    if (dot(direction, disc.towards) >= disc.cos_edge) sum += disc.radiance;
  return sum;
}

Rgb Environment::sky(Vec3d direction) const {
  if (!image) return color;
  constexpr double pi = std::numbers::pi;
  const double azimuth = std::atan2(direction.x, -direction.z);  // 0 at -z, pi/2 at +x
  const double turned = azimuth / (2.0 * pi) + std::remainder(rotation, 360.0) / 360.0;
  const double height = std::asin(std::clamp(direction.y, -1.0, 1.0)) / pi;
  return scale * bilinear(*image, (0.5 + turned) * image->width, (0.5 - height) * image->height,
                          Rows::clamp);
}

}  // namespace portalens
