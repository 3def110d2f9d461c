/// \file
/// A drawing as SVG 1.1.
#pragma once

#include <string>

#include "app/drawing.h"

namespace portalens {

/// A whole file. Whatever the texts hold, it is well-formed: bytes that are no UTF-8, and control
/// characters, become U+FFFD.
[[nodiscard]] std::string svg_text(const Drawing& drawing);

}  // namespace portalens
