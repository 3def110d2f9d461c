/// \file
/// Drawing with pixels.
#pragma once

#include "app/drawing.h"
#include "core/image.h"

namespace portalens {

/// The drawing as three channels of sRGB, 0 to 1, with smooth edges. The same bits always.
[[nodiscard]] Image rasterized(const Drawing& drawing);

}  // namespace portalens
