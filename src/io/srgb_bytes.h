/// \file
/// Linear values as the bytes of an 8-bit sRGB picture.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace portalens {

/// The byte nearest to 255 times the sRGB curve, as `srgb_from_linear` has it in double, without
/// its power.
class SrgbBytes {
 public:
  SrgbBytes();

  /// @param linear  below 0 and above 1 it is clamped; not a number gives 0
  [[nodiscard]] std::uint8_t operator()(float linear) const;

  /// The smallest value that gets that byte or a larger one.
  [[nodiscard]] float least(std::uint8_t byte) const { return least_[byte]; }

 private:
  std::array<float, 256> least_{};
  std::vector<std::uint8_t> at_;  ///< of the smallest value that has these upper 16 bits
};

}  // namespace portalens
