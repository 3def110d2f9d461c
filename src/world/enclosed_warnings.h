/// \file
/// What lies within a closed surface: the camera, a lamp, another surface.
#pragma once

#include "world/warnings.h"

namespace portalens {

/// Adds a remark where the camera lies within a shape. What lies in one where the camera does not
/// is a warning; where there are portals, which may lead into it, a remark.
void observe_enclosed(const World& world, Observations& observations);

}  // namespace portalens
