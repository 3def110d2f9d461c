// What GYOTO is held to is right.
#include "support/gyoto.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace portalens::benchmarks {
namespace {

/// By the midpoint rule with r = r0 / (1 - w²).
double sweep_by_quadrature(double b, double from) {
  double low = 3.0, high = b;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (middle / std::sqrt(1.0 - 2.0 / middle) < b ? low : high) = middle;
  }
  const double r0 = high, start = from > 0.0 ? std::sqrt(1.0 - r0 / from) : 0.0;
  const int cells = 200000;
  double sum = 0.0;
  for (int i = 0; i < cells; ++i) {
    const double w = start + (1.0 - start) * (i + 0.5) / cells;
    const double u = (1.0 - w * w) / r0;
    const double square = 1.0 / (b * b) - u * u * (1.0 - 2.0 * u);
    sum += 2.0 * w / r0 / std::sqrt(square);
  }
  return sum * (1.0 - start) / cells;
}

TEST(SchwarzschildSweep, IsTheIntegralOverThePath) {
  for (const double b : {5.3, 6.0, 10.0, 40.0}) {
    EXPECT_NEAR(schwarzschild_half_sweep(b), sweep_by_quadrature(b, 0.0), 1e-7) << b;
    for (const double r : {50.0, 100.0, 1000.0})
      EXPECT_NEAR(schwarzschild_sweep(b, r), sweep_by_quadrature(b, r), 1e-7) << b << " " << r;
  }
}

TEST(SchwarzschildSweep, BendsWeaklyByFourOverB) {
  const double b = 1e5;
  EXPECT_NEAR(2.0 * schwarzschild_half_sweep(b) - std::numbers::pi, 4.0 / b, 1e-8);
}

TEST(Programs, AreFoundAlongThePath) {
  ASSERT_TRUE(find_program("sh"));
  EXPECT_EQ(find_program(*find_program("sh")), find_program("sh"));
  EXPECT_FALSE(find_program("no-program-has-this-name"));
}

}  // namespace
}  // namespace portalens::benchmarks
