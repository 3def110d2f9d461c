/// \file
/// What lies in one plane and shares an area there: doors, pictures, and what was not meant so.
#pragma once

#include "world/warnings.h"

namespace portalens {

/// Adds a remark of what hangs on something larger where the camera may see it, and a warning of
/// any other two, or of a portal in sight that turns its open back to the camera as its pair does.
void observe_flush_faces(const World& world, Observations& observations);

}  // namespace portalens
