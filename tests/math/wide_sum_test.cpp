// a b + c of packs without an instruction for it is what the processor's own would give.
#include "math/wide_sum.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "math/pack.h"
#include "math/random.h"
#include "support/scale.h"

namespace portalens::test {
namespace {

using Four = std::array<float, 4>;

Four by_doubles(const Four& a, const Four& b, const Four& c) {
  using P = Pack<xsimd::sse2>;
  Four result;
  multiply_add_by_doubles(P::load_unaligned(a.data()), P::load_unaligned(b.data()),
                          P::load_unaligned(c.data()))
      .store_unaligned(result.data());
  return result;
}

void expect_rounded_once(const Four& a, const Four& b, const Four& c) {
  const Four found = by_doubles(a, b, c);
  for (int i = 0; i < 4; ++i) {
    const float expected = std::fma(a[i], b[i], c[i]);
    if (std::isnan(expected))
      EXPECT_TRUE(std::isnan(found[i])) << a[i] << " " << b[i] << " " << c[i];
    else
      EXPECT_EQ(std::bit_cast<std::uint32_t>(found[i]), std::bit_cast<std::uint32_t>(expected))
          << a[i] << " " << b[i] << " " << c[i];
  }
}

TEST(WideSum, IsRoundedOnceWhateverBitsItsNumbersHave) {
  const auto any_bits = [](int i, int which) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(combined(i, which)));
  };
  const auto middling = [](int i, int which) {
    const std::uint64_t bits = combined(i, which);
    const float size = std::ldexp(1.0f, static_cast<int>(bits % 20) - 10);
    return static_cast<float>(random_number(bits, 0) - 0.5) * size;
  };
  for (int i = 0; i < scaled(100000); ++i) {
    Four any[3], middle[3];
    for (int k = 0; k < 12; ++k) {
      any[k % 3][k / 3] = any_bits(i, k);
      middle[k % 3][k / 3] = middling(i, k);
    }
    expect_rounded_once(any[0], any[1], any[2]);
    expect_rounded_once(middle[0], middle[1], middle[2]);
  }
}

TEST(WideSum, IsRoundedOnceWhereTwiceWouldBeWrong) {
  // Their product is 1 - 2⁻³⁶. Half a digit of an odd c times that is no tie, but is one as a
  // double.
  constexpr float less = 1.0f - 0x1p-18f, more = 1.0f + 0x1p-18f;
  constexpr float odd = 1.0f + 0x1p-23f, odd_of_few_digits = 0x1p-127f + 0x1p-149f;
  Four a = {less * 0x1p-12f, less * 0x1p8f, less * 0x1p-32f, less * 0x1p-75f};
  const Four b = {more * 0x1p-12f, more * 0x1p8f, more * 0x1p-32f, more * 0x1p-75f};
  const Four c = {odd, odd * 0x1p40f, -odd * 0x1p-40f, odd_of_few_digits};
  for (int sign = 0; sign < 2; ++sign) {
    for (int i = 0; i < 4; ++i) {
      const double twice = static_cast<double>(a[i]) * b[i] + c[i];
      EXPECT_NE(static_cast<float>(twice), std::fma(a[i], b[i], c[i])) << i;
    }
    expect_rounded_once(a, b, c);
    for (float& factor : a) factor = -factor;
  }
}

TEST(WideSum, TakesWhatIsNoNumberForWhatItIs) {
  constexpr float infinite = std::numeric_limits<float>::infinity();
  constexpr float nothing = std::numeric_limits<float>::quiet_NaN();
  constexpr float largest = std::numeric_limits<float>::max();
  expect_rounded_once({infinite, 1.0f, largest, largest}, {2.0f, 3.0f, largest, 1.0f},
                      {1.0f, -infinite, 1.0f, 0x1p103f});
  expect_rounded_once({nothing, 0.0f, 1.0f, infinite}, {1.0f, infinite, 1.0f, 1.0f},
                      {1.0f, 1.0f, nothing, -infinite});
  expect_rounded_once({0.0f, -0.0f, 1.0f, -1.0f}, {1.0f, 1.0f, 1.0f, 0.0f},
                      {-0.0f, -0.0f, -1.0f, 0.0f});
}

}  // namespace
}  // namespace portalens::test
