/// \file
/// Hashing of a field's discrete decisions. A signature is the sum (modulo 2^64) of one hash for
/// each contribution to the field, so that what does not contribute does not show.
#pragma once

#include <cstdint>

namespace portalens {

/// Mixes one more decision into a path of them (the finalizer of splitmix64).
[[nodiscard]] constexpr std::uint64_t mix_decision(std::uint64_t path, std::uint64_t decision) {
  std::uint64_t z = (path ^ (decision + 0x632be59bd9b4e019U)) + 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31);
}

}  // namespace portalens
