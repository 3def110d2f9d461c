#include "shading/area_light.h"

#include <array>
#include <cmath>
#include <numbers>

#include "geometry/extent.h"
#include "geometry/two_lengths.h"
#include "shading/lamp_input.h"

namespace portalens {
namespace {

bool is_visible(Parameters& parameters) { return parameters.boolean("visible", true); }

Vec3d lamp_position(Parameters& parameters) {
  return to_vec3(parameters.triple("position", coordinate));
}

/// What its height goes along: `up`, as far as that leads aside of its direction. A lamp that looks
/// straight up or down has -z for it, if nothing is said.
Vec3d up_of(Parameters& parameters, Vec3d direction) {
  const bool told = parameters.has("up");
  Vec3d up = to_vec3(parameters.triple("up", coordinate, Triple{0, 1, 0}));
  const auto aside = [&] { return up - direction * dot(up, direction); };
  const auto leads_aside = [&] { return length(aside()) > 1e-6 * length(up); };
  if (!leads_aside()) {
    if (told)
      parameters.fault("up", "'up' leads along 'direction'",
                       "give an 'up' that points aside of it, or none");
    up = std::fabs(direction.z) < 0.5 ? Vec3d{0, 0, -1} : Vec3d{0, 1, 0};
  }
  return normalize(aside());
}

Quad rectangle(Vec3d middle, Vec3d direction, Vec3d up, double width, double height) {
  const Vec3d x = cross(up, direction) * (0.5 * width), y = up * (0.5 * height);
  const std::array<Vec3d, 4> corners{middle - x - y, middle + x - y, middle + x + y,
                                     middle - x + y};
  return Quad(corners);
}

/// The shape, if it is large enough where it lies; else, after a fault, one that is.
template <class Any>
Any sound(Parameters& parameters, std::string_view key, Any shape, double least, Any otherwise) {
  return extent_allowed(parameters, key, shape.bounds(), least) ? shape : otherwise;
}

}  // namespace

RectangleLight RectangleLight::from(Parameters& parameters) {
  const Vec3d middle = lamp_position(parameters), direction = lamp_direction(parameters);
  const Vec3d up = up_of(parameters, direction);
  const auto size = two_lengths(parameters, "size", OneNumber::stands_for_both,
                                "give [width, height], or a number for both: width across 'up', "
                                "height along it");
  const Quad usual = rectangle({}, direction, up, 1.0, 1.0);
  const auto shape = [&] {
    const auto [width, height] = *size;
    return sound(parameters, "size", rectangle(middle, direction, up, width, height),
                 std::fmin(width, height), usual);
  };
  const Rgb radiance = lamp_intensity(parameters);
  return {size ? shape() : usual, radiance, is_visible(parameters)};
}

DiscLight DiscLight::from(Parameters& parameters) {
  const Vec3d middle = lamp_position(parameters), direction = lamp_direction(parameters);
  const double radius = parameters.number("radius", positive);
  const Disk shape = sound(parameters, "radius", Disk(middle, direction, radius), radius,
                           Disk({}, direction, 1.0));
  const Rgb radiance = lamp_intensity(parameters);
  return {shape, radiance, is_visible(parameters)};
}

/// Its power is that of a point of the same intensity: 4 pi I = pi L 4 pi r².
SphereLight SphereLight::from(Parameters& parameters) {
  const Vec3d middle = lamp_position(parameters);
  const double radius = parameters.number("radius", positive);
  const Sphere shape = sound(parameters, "radius", Sphere(middle, radius), radius, Sphere({}, 1.0));
  const Rgb intensity = lamp_intensity(parameters);
  const Rgb radiance = intensity / (std::numbers::pi * radius * radius);
  if (!is_finite(radiance) && radius > 0.0)
    parameters.fault("intensity", "so much light from so small a lamp is beyond all numbers",
                     "make the lamp larger, or less bright");
  return {shape, is_finite(radiance) ? radiance : Rgb{}, is_visible(parameters)};
}

}  // namespace portalens
