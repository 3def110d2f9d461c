/// \file
/// Pairs of random numbers that are spread evenly, whatever their count: the first two dimensions
/// of Sobol's sequence, scrambled after Owen by hashing. Burley, "Practical Hash-based Owen
/// Scrambling", JCGT 9(4), 2020; the hash is Laine and Karras's, with Vegdahl's constants.
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

/// Pair `index` of the sequence that belongs to this key, in [0, 1)². Any 2^k of them that begin at
/// a multiple of 2^k are a (0,2)-net: each box of area 2^-k, of whatever shape, holds one. The mean
/// of a smooth function over them errs by less than N^-1/2. Sequences of different keys are
/// independent.
[[nodiscard]] constexpr std::array<double, 2> sobol_pair(std::uint64_t key, std::uint32_t index) {
  const auto seed = [key](std::uint32_t use) {
    return static_cast<std::uint32_t>(combined(key, use) >> 32);
  };
  const std::uint32_t shuffled = nested_scramble(index, seed(0));
  return {nested_scramble(reverse_bits(shuffled), seed(1)) * 0x1p-32,
          nested_scramble(sobol_second(shuffled), seed(2)) * 0x1p-32};
}

}  // namespace portalens
