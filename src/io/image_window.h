/// \file
/// What a picture shows, where the pixels of its file are more or fewer.
#pragma once

#include <cstdint>
#include <vector>

namespace portalens {

/// A rectangle of pixels, from its top left.
struct PixelWindow {
  std::int64_t x = 0, y = 0;
  int width = 0, height = 0;
  [[nodiscard]] bool operator==(const PixelWindow&) const = default;
};

[[nodiscard]] bool share_a_pixel(const PixelWindow& a, const PixelWindow& b);

/// The pixels within `display` of a file that has those within `data`: all others are 0.
/// @param pixels  row by row, `channels` floats each
[[nodiscard]] std::vector<float> shown(std::vector<float> pixels, int channels,
                                       const PixelWindow& data, const PixelWindow& display);

}  // namespace portalens
