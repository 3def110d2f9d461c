/// \file
/// A picture in memory, and writing it to a file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace portalens::api {

/// A named plane of numbers, one a pixel, row by row from the top left.
struct Channel {
  std::string name;
  std::vector<float> values;
};

/// Linear radiance, row by row from the top left, three floats (red, green, blue) a pixel.
struct Picture {
  int width = 0, height = 0;    ///< pixels
  std::vector<float> rgb;       ///< 3 · width · height numbers
  std::vector<Channel> layers;  ///< what else is known of each pixel, by channels

  /// The red of a pixel; green and blue stand behind it.
  /// @pre 0 <= x < width, 0 <= y < height
  [[nodiscard]] const float* at(int x, int y) const {
    return rgb.data() + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                             static_cast<std::size_t>(x));
  }
};

/// Names and texts for a file's header.
using Metadata = std::vector<std::pair<std::string, std::string>>;

/// Writes a picture as its name's suffix says: `.exr` (float, linear, with layers and metadata),
/// `.png` or, where the build has libjpeg-turbo, `.jpg` (8 bits, sRGB; no layers). A file that
/// stands there is replaced when the new one is whole, and not before.
/// @throws Error (asked) if the suffix is another, the sizes don't fit, or layers are to go into
/// another than an EXR; Error (work) if the file can't be written, or a number is not finite
void write_picture(const std::filesystem::path& file, const Picture& picture,
                   const Metadata& metadata = {});

}  // namespace portalens::api
