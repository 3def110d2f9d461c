/// \file
/// What a [[light]] table says of any kind of lamp.
#pragma once

#include "core/parameters.h"
#include "math/vec3.h"

namespace portalens {

/// `intensity`, a number or one for each colour, times `color` or that of a black body of
/// `temperature` kelvin (of luminance 1).
[[nodiscard]] Rgb lamp_intensity(Parameters& parameters);

/// `direction`, in which its light goes: a unit vector.
[[nodiscard]] Vec3d lamp_direction(Parameters& parameters);

}  // namespace portalens
