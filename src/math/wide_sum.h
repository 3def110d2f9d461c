/// \file
/// a b + c of four floats, rounded once, on processors without an instruction for it.
#pragma once

#include <emmintrin.h>

namespace portalens {

/// Two doubles that are a b + c of floats, which makes the product exact. What rounds the sum to a
/// float is right unless the sum itself has been rounded, to a tie between two floats.
/// @tparam P  the pack: an engine's own, so that no two instruction sets share it
template <class P>
struct WideSum {
  __m128d product, addend, sum;

  WideSum(__m128d a, __m128d b, __m128d c)
      : product(_mm_mul_pd(a, b)), addend(c), sum(_mm_add_pd(product, c)) {}

  /// Whether one of all four may be a tie; those that no float's full digits hold, always.
  [[nodiscard]] static bool may_tie(const WideSum& first, const WideSum& second) {
    const __m128 a = _mm_castpd_ps(first.sum), b = _mm_castpd_ps(second.sum);
    const __m128i low = _mm_castps_si128(_mm_shuffle_ps(a, b, _MM_SHUFFLE(2, 0, 2, 0)));
    const __m128i high = _mm_castps_si128(_mm_shuffle_ps(a, b, _MM_SHUFFLE(3, 1, 3, 1)));
    constexpr int beyond_float = 0x1fffffff, half = 0x10000000;
    constexpr int least_float = 0x38100000;  // the upper half of 2⁻¹²⁶ as a double
    const __m128i ties =
        _mm_cmpeq_epi32(_mm_and_si128(low, _mm_set1_epi32(beyond_float)), _mm_set1_epi32(half));
    const __m128i size = _mm_and_si128(high, _mm_set1_epi32(0x7fffffff));
    const __m128i small = _mm_and_si128(_mm_cmpgt_epi32(size, _mm_setzero_si128()),
                                        _mm_cmplt_epi32(size, _mm_set1_epi32(least_float)));
    return _mm_movemask_epi8(_mm_or_si128(ties, small)) != 0;
  }

  /// Odd in the last bit where it has been rounded, which is no tie: S. Boldo, G. Melquiond,
  /// "Emulation of FMA and correctly rounded sums", 2008.
  [[nodiscard]] __m128d to_odd() const {
    const __m128d added = _mm_sub_pd(sum, product);
    const __m128d rest =
        _mm_add_pd(_mm_sub_pd(product, _mm_sub_pd(sum, added)), _mm_sub_pd(addend, added));
    const __m128d none = _mm_setzero_pd();
    // Not what is no number.
    const __m128d rounded = _mm_or_pd(_mm_cmplt_pd(rest, none), _mm_cmpgt_pd(rest, none));
    const auto first_bit = [](__m128d x) { return _mm_srli_epi64(_mm_castpd_si128(x), 63); };
    const __m128i too_far = first_bit(_mm_and_pd(_mm_xor_pd(rest, sum), rounded));
    const __m128i nearer = _mm_sub_epi64(_mm_castpd_si128(sum), too_far);
    return _mm_castsi128_pd(_mm_or_si128(nearer, first_bit(rounded)));
  }
};

/// a b + c, rounded once, without an instruction for it.
template <class P>
[[nodiscard, gnu::noinline]] P multiply_add_by_doubles(P a, P b, P c) {
  const auto last = [](__m128 x) { return _mm_cvtps_pd(_mm_movehl_ps(x, x)); };
  WideSum<P> first(_mm_cvtps_pd(a), _mm_cvtps_pd(b), _mm_cvtps_pd(c));
  WideSum<P> second(last(a), last(b), last(c));
  if (WideSum<P>::may_tie(first, second)) {
    first.sum = first.to_odd();
    second.sum = second.to_odd();
  }
  return _mm_movelh_ps(_mm_cvtpd_ps(first.sum), _mm_cvtpd_ps(second.sum));
}

}  // namespace portalens
