/// \file
/// A rectangle of linear float pixels.
#pragma once

#include <cstddef>
#include <vector>

namespace portalens {

/// Row by row from the top left; `channels` floats a pixel.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<float> pixels;

  Image() = default;
  Image(int its_width, int its_height, int its_channels)
      : width(its_width),
        height(its_height),
        channels(its_channels),
        pixels(static_cast<std::size_t>(its_width) * its_height * its_channels) {}

  [[nodiscard]] float* at(int x, int y) {
    return pixels.data() + (static_cast<std::size_t>(y) * width + x) * channels;
  }
  [[nodiscard]] const float* at(int x, int y) const {
    return pixels.data() + (static_cast<std::size_t>(y) * width + x) * channels;
  }
};

}  // namespace portalens
