/// \file
/// Whether two portals lie in each other.
#pragma once

#include "portal/portal.h"

namespace portalens {

/// Whether the two lie in one plane, facing the same way, and share an area.
[[nodiscard]] bool portals_overlap(const Portal& a, const Portal& b);

}  // namespace portalens
