/// \file
/// How strong a lens is in the picture.
#pragma once

#include <optional>

#include "world/world.h"

namespace portalens {

/// How many pixels across the ring is to which a mass alone bends what lies far behind it
/// (Einstein's): light that turns by 2 m/b passes at b = sqrt(2 m D), m = h(0) G M / c², D the
/// distance of the camera. Nothing for an orthographic camera, a mass that repels, a ring beyond
/// the mass's influence, or one so wide that weak bending doesn't tell it.
[[nodiscard]] std::optional<double> ring_pixels(const World& world, const Mass& mass);

}  // namespace portalens
