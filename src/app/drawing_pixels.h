/// \file
/// A drawing as pixels.
#pragma once

#include "app/drawing.h"
#include "core/image.h"

namespace portalens {

/// Three linear channels.
[[nodiscard]] Image pixels_of(const Drawing& drawing);

}  // namespace portalens
