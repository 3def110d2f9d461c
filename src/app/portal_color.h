/// \file
/// The colours of portals in drawings.
#pragma once

#include <cstdint>
#include <span>

#include "app/drawing.h"
#include "portal/portal.h"

namespace portalens {

/// The colour that the portal's name names, or the next of a list.
[[nodiscard]] Color portal_color(std::span<const Portal> portals, std::uint32_t portal);

}  // namespace portalens
