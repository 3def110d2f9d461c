/// \file
/// A disc in the sky, as a sun is.
#pragma once

#include <numbers>

#include "math/vec3.h"

namespace portalens {

struct SkyDisc {
  Vec3d towards;          ///< unit vector to its middle
  double cos_edge = 1.0;  ///< of the angle between its middle and its edge
  Rgb radiance;           ///< W/(m² sr), beside that of the sky

  [[nodiscard]] bool is_seen_in(Vec3d direction) const {
    return dot(direction, towards) >= cos_edge;
  }
  /// Of directions that are drawn from all of it alike, per solid angle.
  [[nodiscard]] double density() const { return 0.5 / (std::numbers::pi * (1.0 - cos_edge)); }
};

}  // namespace portalens
