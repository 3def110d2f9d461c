/// \file
/// Picture files written without any library, and without compression: what builds without
/// OpenEXR and libspng write. Everybody else reads them.
#pragma once

#include <vector>

#include "io/image_encode.h"

namespace portalens {

/// As `encode_exr`, in scan lines of 32-bit floats.
[[nodiscard]] std::vector<unsigned char> plain_exr(const EncodedPicture& picture);

/// As `encode_png`, in stored blocks.
[[nodiscard]] std::vector<unsigned char> plain_png(const EncodedPicture& picture);

}  // namespace portalens
