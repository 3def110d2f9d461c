/// \file
/// The checksums of PNG (ISO/IEC 15948, annex D) and zlib (RFC 1950).
#pragma once

#include <cstdint>
#include <string_view>

namespace portalens {

/// Of the polynomial 0xedb88320, reflected.
[[nodiscard]] std::uint32_t crc32(std::string_view bytes);

/// @param begun  the sum of the bytes before, 1 for none
[[nodiscard]] std::uint32_t adler32(std::string_view bytes, std::uint32_t begun = 1);

}  // namespace portalens
