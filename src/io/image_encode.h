/// \file
/// From a picture to the bytes of its file.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <vector>

#include "io/image.h"

namespace portalens {

/// A picture that is to become the bytes of a file. Its channels are of its size.
struct EncodedPicture {
  const std::filesystem::path& file;
  int width, height;
  const std::vector<ChannelView>& channels;
  const Metadata& metadata;
  Packing packing;

  [[nodiscard]] std::size_t row() const { return static_cast<std::size_t>(width); }
};

/// Its red, green and blue.
/// @throws WorkError if it lacks one
[[nodiscard]] std::array<const ChannelView*, 3> colors_of(const EncodedPicture& picture);

/// Float channels, linear, with the metadata.
/// @throws WorkError with the cause
[[nodiscard]] std::vector<unsigned char> encode_exr(const EncodedPicture& picture);

/// 8 bits of R, G, B, sRGB.
/// @throws WorkError with the cause
[[nodiscard]] std::vector<unsigned char> encode_png(const EncodedPicture& picture);

/// Whether this build has a library that does.
[[nodiscard]] bool encodes_jpeg();
/// The same, not quite: what JPEG leaves of it.
/// @throws WorkError with the cause
[[nodiscard]] std::vector<unsigned char> encode_jpeg(const EncodedPicture& picture);

}  // namespace portalens
