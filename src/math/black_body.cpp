#include "math/black_body.h"

#include <algorithm>
#include <cmath>

namespace portalens {
namespace {

/// A bell whose sides have different widths.
double lobe(double nanometres, double middle, double left, double right) {
  const double t = (nanometres - middle) * (nanometres < middle ? left : right);
  return std::exp(-0.5 * t * t);
}

/// The standard observer's matching functions x̄, ȳ, z̄ at a wavelength.
Vec3d matching(double nanometres) {
  const auto at = [&](double middle, double left, double right) {
    return lobe(nanometres, middle, left, right);
  };
  return {0.362 * at(442.0, 0.0624, 0.0374) + 1.056 * at(599.8, 0.0264, 0.0323) -
              0.065 * at(501.1, 0.0490, 0.0382),
          0.821 * at(568.8, 0.0213, 0.0247) + 0.286 * at(530.9, 0.0613, 0.0322),
          1.217 * at(437.0, 0.0845, 0.0278) + 0.681 * at(459.0, 0.0385, 0.0725)};
}

/// Linear sRGB of CIE XYZ (IEC 61966-2-1).
Rgb to_srgb(Vec3d xyz) {
  return {dot(Vec3d{3.2406, -1.5372, -0.4986}, xyz), dot(Vec3d{-0.9689, 1.8758, 0.0415}, xyz),
          dot(Vec3d{0.0557, -0.2040, 1.0570}, xyz)};
}

}  // namespace

Rgb black_body_color(double temperature) {
  constexpr double second_radiation_constant = 1.438776877e7;  // h c / k, nm K
  const auto exponent = [&](double nanometres) {
    return second_radiation_constant / (nanometres * temperature);
  };
  Vec3d xyz;
  for (double nanometres = 380.0; nanometres <= 780.0; nanometres += 5.0) {
    // Beside that of the longest wavelength, so that no temperature is too low.
    const double relative = std::exp(exponent(780.0) - exponent(nanometres)) *
                            std::expm1(-exponent(780.0)) / std::expm1(-exponent(nanometres));
    xyz += matching(nanometres) * (relative * std::pow(780.0 / nanometres, 5));
  }
  const Rgb color = to_srgb(xyz / xyz.y);
  return {std::max(color.x, 0.0), std::max(color.y, 0.0), std::max(color.z, 0.0)};
}

}  // namespace portalens
