/// \file
/// The sRGB transfer curve, IEC 61966-2-1.
#pragma once

#include <cmath>

namespace portalens {

/// @param value  0 to 1 as a file has it  @return linear
template <class Real>
[[nodiscard]] Real linear_from_srgb(Real value) {
  return value <= Real(0.04045) ? value / Real(12.92)
                                : std::pow((value + Real(0.055)) / Real(1.055), Real(2.4));
}

/// @param value  linear, 0 to 1  @return as a file has it
template <class Real>
[[nodiscard]] Real srgb_from_linear(Real value) {
  return value <= Real(0.0031308)
             ? value * Real(12.92)
             : Real(1.055) * std::pow(value, Real(1) / Real(2.4)) - Real(0.055);
}

}  // namespace portalens
