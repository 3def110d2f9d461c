/// \file
/// Where in its pixel each camera sample lies, and what its random numbers are made from.
#pragma once

#include <array>
#include <cstdint>

#include "math/random.h"
#include "math/sobol.h"

namespace portalens {

/// What the keys of all pixels begin with.
struct FilmKey {
  std::uint64_t key;
  constexpr explicit FilmKey(std::uint64_t seed) : key(combined(0, seed)) {}
};

/// The camera samples of one pixel, after Sobol (math/sobol.h). Pixels are independent of each
/// other.
class PixelSampler {
 public:
  constexpr PixelSampler(std::uint32_t x, std::uint32_t y, std::uint64_t seed)
      : PixelSampler(FilmKey(seed), x, y) {}
  /// For many pixels: with their film's key at hand.
  constexpr PixelSampler(FilmKey film, std::uint32_t x, std::uint32_t y)
      : key_(combined(combined(film.key, x), y)) {}

  /// In [0, 1)².
  [[nodiscard]] constexpr std::array<double, 2> position(std::uint32_t sample) const {
    return sobol_pair(~key_, sample);
  }

  /// From which all other random numbers of the pixel's samples are made, with a sample's number.
  [[nodiscard]] constexpr std::uint64_t random_key() const { return mixed(key_); }

 private:
  std::uint64_t key_;
};

}  // namespace portalens
