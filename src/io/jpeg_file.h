/// \file
/// JPEG through libjpeg-turbo's own interface, which tells its caller of every fault.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "io/samples.h"

namespace portalens {

/// CMYK becomes red, green and blue: what ink leaves of white.
/// @throws Refusal with the cause, also where the file ends before its picture does
[[nodiscard]] Samples decode_jpeg(std::string_view bytes);

/// Of quality 95, colours at half the resolution.
/// @param rgb  8 bits, sRGB, row by row
/// @throws std::exception with the cause
[[nodiscard]] std::vector<unsigned char> pack_jpeg(int width, int height,
                                                   std::span<const unsigned char> rgb);

}  // namespace portalens
