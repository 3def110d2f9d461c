#include "shading/environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace portalens {
namespace {

using std::numbers::pi;

double turns(double degrees) { return std::remainder(degrees, 360.0) / 360.0; }

}  // namespace

Environment Environment::from(Parameters& parameters, const ImageLoader& load) {
  Environment environment;
  const double intensity = parameters.number("intensity", non_negative, 1.0);
  const auto color_or = [&](Rgb usual) {
    const Triple given =
        parameters.triple("color", non_negative, Triple{usual.x, usual.y, usual.z});
    return to_vec3(given) * intensity;
  };
  environment.lights = parameters.boolean("lights", parameters.has("image"));
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
  Rgb sum = radiance_beside_discs(direction);
  for (const SkyDisc& disc : discs)
    if (disc.is_seen_in(direction)) sum += disc.radiance;
  return sum;
}

Rgb Environment::radiance_beside_discs(Vec3d direction) const {
  if (!image) return color;
  const double azimuth = std::atan2(direction.x, -direction.z);  // 0 at -z, pi/2 at +x
  const double height = std::asin(std::clamp(direction.y, -1.0, 1.0)) / pi;
  return radiance_at(0.5 + (azimuth / (2.0 * pi) + turns(rotation)), 0.5 - height);
}

bool is_black(const Environment& sky) {
  if (!sky.image) return sky.color == Rgb{};
  return sky.scale * brightest(Picture{sky.image}) == Rgb{};
}

Vec3d Environment::direction_of(double right, double down) const {
  const double azimuth = 2.0 * pi * (right - 0.5 - turns(rotation));
  const double sine = std::cos(pi * down), cosine = std::sin(pi * down);
  return {cosine * std::sin(azimuth), sine, -cosine * std::cos(azimuth)};
}

Rgb Environment::radiance_at(double right, double down) const {
  if (!image) return color;
  return scale * bilinear(*image, right * image->width, down * image->height, Rows::clamp);
}

}  // namespace portalens
