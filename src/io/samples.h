/// \file
/// What a decoder gives of a picture that it reads at once: PNG, JPEG.
#pragma once

#include <string>
#include <vector>

namespace portalens {

/// Values from 0 to 1 as the file codes them, pixel by pixel, all channels of each.
struct Samples {
  int width = 0, height = 0;
  std::vector<std::string> channels;  ///< R, G, B, or Y where it is gray; then perhaps A
  std::vector<float> values;
};

}  // namespace portalens
