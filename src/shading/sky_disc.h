/// \file
/// A disc in the sky, as a sun is.
#pragma once

#include "math/vec3.h"

namespace portalens {

struct SkyDisc {
  Vec3d towards;          ///< unit vector to its middle
  double cos_edge = 1.0;  ///< of the angle between its middle and its edge
  Rgb radiance;           ///< W/(m² sr), beside that of the sky
};

}  // namespace portalens
