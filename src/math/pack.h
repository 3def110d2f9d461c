/// \file
/// Lanes of floats that behave like one `Real`.
///
/// The instruction set is part of every type's name, so that templates of two sets never share a
/// symbol. Only operations that IEEE 754 rounds exactly are used (+ - × ÷ √, a b + c rounded once,
/// and comparisons), and integers, so all sets give the same bits: but for packs that round a b + c
/// twice, which spare processors without an instruction for it most of the time.
#pragma once

#include <cstdint>
#include <type_traits>
#include <xsimd/xsimd.hpp>

#include "math/vec3.h"
#include "math/wide_sum.h"

namespace portalens {

template <class Isa>
using Pack = xsimd::batch<float, Isa>;

/// How often a b + c is rounded.
enum class Rounding { once, twice };

/// a b + c.
template <Rounding rounding, class P>
[[nodiscard]] P multiply_add_of(P a, P b, P c) {
  using Isa = typename P::arch_type;
  if constexpr (rounding == Rounding::twice)
    return a * b + c;
  else if constexpr (std::is_same_v<Isa, xsimd::avx512bw>)
    return _mm512_fmadd_ps(a, b, c);
  else if constexpr (std::is_same_v<Isa, xsimd::fma3<xsimd::avx2>>)
    return _mm256_fmadd_ps(a, b, c);
  else
    return multiply_add_by_doubles(a, b, c);
}

/// c - a b.
template <Rounding rounding, class P>
[[nodiscard]] P subtract_product_of(P c, P a, P b) {
  using Isa = typename P::arch_type;
  if constexpr (rounding == Rounding::twice)
    return c - a * b;
  else if constexpr (std::is_same_v<Isa, xsimd::avx512bw>)
    return _mm512_fnmadd_ps(a, b, c);
  else if constexpr (std::is_same_v<Isa, xsimd::fma3<xsimd::avx2>>)
    return _mm256_fnmadd_ps(a, b, c);
  else
    return multiply_add_by_doubles(-a, b, c);
}

/// Where one mask is true, and the other is not. In xsimd 8 the ^ of masks is | with AVX-512, and
/// their != compares numbers with SSE4.
template <class P>
[[nodiscard]] typename P::batch_bool_type one_of(typename P::batch_bool_type x,
                                                 typename P::batch_bool_type y) {
  if constexpr (std::is_same_v<typename P::arch_type, xsimd::avx512bw>)
    return x != y;
  else
    return x ^ y;
}

/// Bit i for lane i: xsimd 8 has no function for that.
template <class P>
[[nodiscard]] std::uint32_t bits_of(typename P::batch_bool_type mask) {
  using Isa = typename P::arch_type;
  if constexpr (std::is_same_v<Isa, xsimd::avx512bw>)
    return static_cast<std::uint32_t>(mask.data);
  else if constexpr (std::is_same_v<Isa, xsimd::fma3<xsimd::avx2>>)
    return static_cast<std::uint32_t>(_mm256_movemask_ps(mask.data));
  else
    return static_cast<std::uint32_t>(_mm_movemask_ps(mask.data));
}

/// 1/√x to within 7.6e-7 of itself, for x > 0: halving the exponent gives a guess, and two steps of
/// Newton's method (the first with the constants that make its largest error least) the digits.
template <Rounding rounding, class P>
[[nodiscard]] P inverse_sqrt_of(P x) {
  using Integers = xsimd::batch<std::int32_t, typename P::arch_type>;
  const auto bits = xsimd::bitwise_cast<Integers>(x);
  P y = xsimd::bitwise_cast<P>(Integers(0x5f1ffff9) - (bits >> 1));
  y = y * P(0.703952253f) * subtract_product_of<rounding>(P(2.38924456f), x * y, y);
  return y * subtract_product_of<rounding>(P(1.5f), P(0.5f) * x * y, y);
}

/// x^(-1/4) to within 0.0025 of itself, for x > 0: enough to choose a step by.
template <Rounding rounding, class P>
[[nodiscard]] P inverse_fourth_root_of(P x) {
  using Integers = xsimd::batch<std::int32_t, typename P::arch_type>;
  const auto bits = xsimd::bitwise_cast<Integers>(x);
  const P y = xsimd::bitwise_cast<P>(Integers(0x4f584800) - (bits >> 2));
  const P y2 = y * y;
  return y * subtract_product_of<rounding>(P(1.25f), P(0.25f) * x * y2, y2);
}

/// Two packs side by side: while one waits for its result, the other works.
template <class P, Rounding rounding = Rounding::once>
struct Pair {
  P a, b;

  struct Mask {
    typename P::batch_bool_type a, b;

    friend Mask operator&(Mask x, Mask y) { return {x.a & y.a, x.b & y.b}; }
    friend Mask operator|(Mask x, Mask y) { return {x.a | y.a, x.b | y.b}; }
    friend Mask operator^(Mask x, Mask y) { return {one_of<P>(x.a, y.a), one_of<P>(x.b, y.b)}; }
    friend Mask operator!(Mask x) { return {!x.a, !x.b}; }
    friend Mask both(Mask x, Mask y) { return x & y; }
    friend bool any(Mask x) { return xsimd::any(x.a | x.b); }
    /// Bit i for lane i.
    friend std::uint32_t bits(Mask x) { return bits_of<P>(x.a) | bits_of<P>(x.b) << P::size; }
  };

  static constexpr int lanes = 2 * static_cast<int>(P::size);

  /// Without values: arrays of lanes are large.
  Pair() = default;
  Pair(P low, P high) : a(low), b(high) {}
  Pair(double x) : a(static_cast<float>(x)), b(static_cast<float>(x)) {}
  Pair(float x) : a(x), b(x) {}
  Pair(int x) : a(static_cast<float>(x)), b(static_cast<float>(x)) {}

  static Pair load(const float* p) {
    return {P::load_unaligned(p), P::load_unaligned(p + P::size)};
  }
  void store(float* p) const {
    a.store_unaligned(p);
    b.store_unaligned(p + P::size);
  }

  friend Pair operator+(Pair x, Pair y) { return {x.a + y.a, x.b + y.b}; }
  friend Pair operator-(Pair x, Pair y) { return {x.a - y.a, x.b - y.b}; }
  friend Pair operator-(Pair x) { return {-x.a, -x.b}; }
  friend Pair operator*(Pair x, Pair y) { return {x.a * y.a, x.b * y.b}; }
  friend Pair operator/(Pair x, Pair y) { return {x.a / y.a, x.b / y.b}; }
  friend Pair multiply_add(Pair x, Pair y, Pair z) {
    return {multiply_add_of<rounding>(x.a, y.a, z.a), multiply_add_of<rounding>(x.b, y.b, z.b)};
  }
  friend Pair subtract_product(Pair z, Pair x, Pair y) {
    return {subtract_product_of<rounding>(z.a, x.a, y.a),
            subtract_product_of<rounding>(z.b, x.b, y.b)};
  }
  friend Mask operator<(Pair x, Pair y) { return {x.a < y.a, x.b < y.b}; }
  friend Mask operator<=(Pair x, Pair y) { return {x.a <= y.a, x.b <= y.b}; }
  friend Mask operator>(Pair x, Pair y) { return {x.a > y.a, x.b > y.b}; }
  friend Mask operator>=(Pair x, Pair y) { return {x.a >= y.a, x.b >= y.b}; }
  friend Mask operator==(Pair x, Pair y) { return {x.a == y.a, x.b == y.b}; }
  friend Pair select(Mask m, Pair x, Pair y) {
    return {xsimd::select(m.a, x.a, y.a), xsimd::select(m.b, x.b, y.b)};
  }
  friend Pair sqrt(Pair x) { return {xsimd::sqrt(x.a), xsimd::sqrt(x.b)}; }
  friend Pair inverse_sqrt(Pair x) {
    return {inverse_sqrt_of<rounding>(x.a), inverse_sqrt_of<rounding>(x.b)};
  }
  friend Pair inverse_fourth_root(Pair x) {
    return {inverse_fourth_root_of<rounding>(x.a), inverse_fourth_root_of<rounding>(x.b)};
  }
  friend Pair abs(Pair x) { return {xsimd::abs(x.a), xsimd::abs(x.b)}; }
  /// y where either is no number, with every instruction set.
  friend Pair min(Pair x, Pair y) { return {xsimd::min(x.a, y.a), xsimd::min(x.b, y.b)}; }
  friend Pair max(Pair x, Pair y) { return {xsimd::max(x.a, y.a), xsimd::max(x.b, y.b)}; }
};

/// As of numbers, but rounded less often.
template <class P, Rounding rounding>
[[nodiscard]] Pair<P, rounding> dot(Vec3<Pair<P, rounding>> a, Vec3<Pair<P, rounding>> b) {
  return multiply_add(a.z, b.z, multiply_add(a.y, b.y, a.x * b.x));
}

}  // namespace portalens
