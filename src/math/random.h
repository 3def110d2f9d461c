/// \file
/// Random numbers that are a function of where they are used: no generator, no state, no order.
/// The mixer is the finaliser of SplitMix64 (Steele, Lea & Flood 2014), applied twice.
#pragma once

#include <cstdint>

namespace portalens {

/// A bijection of 64 bits in which every input bit reaches every output bit.
[[nodiscard]] constexpr std::uint64_t mixed(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

/// A key that depends on both. Inlined always: so it may run beside what is computed about it.
[[nodiscard, gnu::always_inline]] constexpr std::uint64_t combined(std::uint64_t key,
                                                                   std::uint64_t with) {
  return mixed(mixed(key) ^ (with * 0xd1342543de82ef95u + 0x2545f4914f6cdd1du));
}

/// Uniform in [0, 1), 53 bits, for this key and dimension.
[[nodiscard]] constexpr double random_number(std::uint64_t key, std::uint64_t dimension) {
  return static_cast<double>(combined(key, dimension) >> 11) * 0x1p-53;
}

}  // namespace portalens
