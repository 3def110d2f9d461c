/// \file
/// Letters as lines, for the rasteriser.
#pragma once

#include <string>
#include <vector>

#include "app/drawing.h"

namespace portalens {

/// The lines of a label's letters, where they are to be drawn.
[[nodiscard]] std::vector<PointChain> letter_lines(const Label& label);

/// Width of those lines, pixels.
[[nodiscard]] double letter_weight(double size);

}  // namespace portalens
