/// \file
/// The colour of what glows.
#pragma once

#include "math/vec3.h"

namespace portalens {

/// Linear sRGB of a black body, of luminance 1: Planck's law, seen by the standard observer of CIE
/// 1931 (from 380 to 780 nm, by the lobes of Wyman, Sloan and Shirley, 2013). What the screen's
/// colours can't mix, below 1,900 K, is clipped at 0.
/// @param temperature  kelvin, > 0
[[nodiscard]] Rgb black_body_color(double temperature);

}  // namespace portalens
