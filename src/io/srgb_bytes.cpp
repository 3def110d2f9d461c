#include "io/srgb_bytes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "io/bits.h"
#include "math/srgb.h"

namespace portalens {
namespace {

constexpr auto bits_of_one = bit_cast<std::uint32_t>(1.0F);

long byte_of(float linear) { return std::lround(255.0 * srgb_from_linear(double{linear})); }

/// Between 0 and 1 numbers are in the order of their bits.
float least_value(long byte) {
  std::uint32_t below = 0, at_least = bits_of_one;
  while (at_least - below > 1) {
    const std::uint32_t middle = below + (at_least - below) / 2;
    (byte_of(bit_cast<float>(middle)) < byte ? below : at_least) = middle;
  }
  return bit_cast<float>(at_least);
}

}  // namespace

SrgbBytes::SrgbBytes() : at_((bits_of_one >> 16) + 1) {
  for (std::size_t byte = 1; byte < least_.size(); ++byte)
    least_[byte] = least_value(static_cast<long>(byte));
  for (std::size_t upper = 0; upper < at_.size(); ++upper) {
    const auto value = bit_cast<float>(static_cast<std::uint32_t>(upper << 16));
    const auto next = std::upper_bound(least_.begin(), least_.end(), value);
    at_[upper] = static_cast<std::uint8_t>(next - least_.begin() - 1);
  }
}

std::uint8_t SrgbBytes::operator()(float linear) const {
  if (!(linear > 0.0F)) return 0;
  if (linear >= 1.0F) return 255;
  // Values with the same upper bits differ by less than a hundredth: by one byte at most.
  const std::uint8_t byte = at_[bit_cast<std::uint32_t>(linear) >> 16];
  return byte < 255 && linear >= least_[byte + 1U] ? static_cast<std::uint8_t>(byte + 1) : byte;
}

}  // namespace portalens
