/// \file
/// How large a picture says it is, read before a decoder believes it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "io/image_bytes.h"

namespace portalens {

inline constexpr std::int64_t max_image_side = 16384;
inline constexpr std::int64_t max_image_pixels = std::int64_t{1} << 27;  // 1.5 GiB of floats

/// Why a picture can't be used.
struct Refusal {
  std::string problem, remedy;
};

/// Looks through the header for all that a decoder takes memory for: width, height, channels,
/// tiles, and the sizes of EXR's attributes.
/// @throws Refusal if it claims a picture larger than the limits, one larger than so few bytes can
///                 hold in that format, or is cut off
void check_claim(std::string_view bytes, ImageFormat format);

}  // namespace portalens
