/// \file
/// A drawing as SVG 1.1.
#pragma once

#include <string>

#include "app/drawing.h"

namespace portalens {

[[nodiscard]] std::string svg_of(const Drawing& drawing);

}  // namespace portalens
