/// \file
/// Where in its pixel each camera sample lies: the first two dimensions of Sobol's sequence,
/// scrambled after Owen by hashing. Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4),
/// 2020; the hash is Laine and Karras's, with Vegdahl's constants.
#pragma once

#include <array>
#include <cstdint>

#include "math/random.h"

namespace portalens {

[[nodiscard]] constexpr std::uint32_t reverse_bits(std::uint32_t v) {
  v = (v << 16) | (v >> 16);
  v = ((v & 0x00ff00ffu) << 8) | ((v & 0xff00ff00u) >> 8);
  v = ((v & 0x0f0f0f0fu) << 4) | ((v & 0xf0f0f0f0u) >> 4);
  v = ((v & 0x33333333u) << 2) | ((v & 0xccccccccu) >> 2);
  return ((v & 0x55555555u) << 1) | ((v & 0xaaaaaaaau) >> 1);
}

/// Owen's nested uniform scrambling: each bit is flipped by a hash of the bits above it.
[[nodiscard]] constexpr std::uint32_t nested_scramble(std::uint32_t v, std::uint32_t seed) {
  v = reverse_bits(v);
  v ^= v * 0x3d20adeau;
  v += seed;
  v *= (seed >> 16) | 1u;
  v ^= v * 0x05526c56u;
  v ^= v * 0x53a22864u;
  return reverse_bits(v);
}

/// The second dimension of Sobol's sequence; the first is `reverse_bits`.
[[nodiscard]] constexpr std::uint32_t sobol_second(std::uint32_t index) {
  std::uint32_t bits = 0;
  for (std::uint32_t direction = 1u << 31; index != 0; index >>= 1, direction ^= direction >> 1)
    if (index & 1u) bits ^= direction;
  return bits;
}

/// What the keys of all pixels begin with.
struct FilmKey {
  std::uint64_t key;
  constexpr explicit FilmKey(std::uint64_t seed) : key(combined(0, seed)) {}
};

/// The camera samples of one pixel. Any 2^k of them that begin at a multiple of 2^k are a
/// (0,2)-net: each box of area 2^-k, of whatever shape, holds one. Pixels are independent of each
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
    const std::uint32_t index = nested_scramble(sample, seed_of(0));
    return {fraction(nested_scramble(reverse_bits(index), seed_of(1))),
            fraction(nested_scramble(sobol_second(index), seed_of(2)))};
  }

  /// From which all other random numbers of this sample are made.
  [[nodiscard]] constexpr std::uint64_t random_key(std::uint32_t sample) const {
    return combined(key_, sample);
  }

 private:
  [[nodiscard]] constexpr std::uint32_t seed_of(std::uint32_t use) const {
    return static_cast<std::uint32_t>(combined(~key_, use) >> 32);
  }
  [[nodiscard]] static constexpr double fraction(std::uint32_t bits) { return bits * 0x1p-32; }

  std::uint64_t key_;
};

}  // namespace portalens
