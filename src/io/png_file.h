/// \file
/// PNG through libspng, which tells its caller of every fault.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "io/samples.h"

namespace portalens {

/// @throws Refusal with the cause; std::bad_alloc
[[nodiscard]] Samples decode_png(std::string_view bytes);

/// @param rgb    8 bits, sRGB, row by row
/// @param level  of deflate: 1 is quick, 9 small
/// @throws std::exception with the cause
[[nodiscard]] std::vector<unsigned char> pack_png(int width, int height,
                                                  std::span<const unsigned char> rgb, int level);

}  // namespace portalens
