// Pictures encoded by the libraries of their formats.
#include "io/image_encode.h"

#include <array>
#include <cstddef>
#include <exception>

#include "io/exr_file.h"
#include "io/jpeg_file.h"
#include "io/png_file.h"
#include "io/srgb_bytes.h"

namespace portalens {
namespace {

/// 8 bits of red, green and blue, sRGB.
std::vector<unsigned char> bytes_of(const EncodedPicture& picture) {
  static const SrgbBytes byte_of;
  const std::array<const ChannelView*, 3> colors = colors_of(picture);
  const std::size_t pixels = picture.row() * static_cast<std::size_t>(picture.height);
  std::vector<unsigned char> bytes(3 * pixels);
  for (std::size_t i = 0; i < pixels; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      bytes[3 * i + c] = byte_of(colors[c]->values[i * colors[c]->step]);
  return bytes;
}

}  // namespace

std::vector<unsigned char> encode_exr(const EncodedPicture& picture) {
  return pack_exr(picture.width, picture.height, picture.channels, picture.metadata,
                  picture.packing);
}

std::vector<unsigned char> encode_png(const EncodedPicture& picture) {
  constexpr int quick = 1, small = 6;
  return pack_png(picture.width, picture.height, bytes_of(picture),
                  picture.packing == Packing::quick ? quick : small);
}

bool encodes_jpeg() { return true; }

std::vector<unsigned char> encode_jpeg(const EncodedPicture& picture) {
  return pack_jpeg(picture.width, picture.height, bytes_of(picture));
}

}  // namespace portalens
