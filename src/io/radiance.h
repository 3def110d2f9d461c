/// \file
/// Pictures of Radiance (`.hdr`, `.pic`), read without a library: none that we know reads the
/// first run-length coding, XYZ, all orientations and exposures.
#pragma once

#include <string_view>

#include "core/image.h"

namespace portalens {

/// Linear red, green and blue of Rec. 709, from the top left: exposures and colour corrections are
/// divided out, XYZ is converted. Out of the range of those primaries a colour has negative values.
/// @param bytes  a file that `check_claim` has taken
/// @throws Refusal if it is broken
[[nodiscard]] Image read_radiance(std::string_view bytes);

}  // namespace portalens
