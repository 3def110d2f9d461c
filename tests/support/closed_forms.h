/// \file
/// The closed forms of one mass without a core (equations.md, sec. 3), by Gauss-Legendre quadrature
/// in long double: they share no code with what they test.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

namespace portalens::closed_form {

inline constexpr double infinite = std::numeric_limits<double>::infinity();

/// Largest root r0 of r exp(m/r - m/R) = b. @pre b is above capture
inline long double turning_point(long double m, long double influence, long double b) {
  const long double shift = std::isinf(influence) ? 0.0L : m / influence;
  long double low = m, high = b + 2.0L * m;
  for (int i = 0; i < 200; ++i) {
    const long double middle = 0.5L * (low + high);
    (middle * std::exp(m / middle - shift) < b ? low : high) = middle;
  }
  return 0.5L * (low + high);
}

/// ∫ b dr / (r sqrt(n² r² - b²)) from the turning point to `radius`: the azimuth swept. With
/// r = r0 / (1 - w²) the integrand is smooth up to the turning point.
inline long double azimuth(long double m, long double r0, long double radius) {
  const long double end = std::isinf(radius) ? 1.0L : std::sqrt(1.0L - r0 / radius);
  constexpr long double node[3] = {0.0L, 0.538469310105683091036L, 0.906179845938663992798L};
  constexpr long double weight[3] = {0.568888888888888888889L, 0.478628670499366468042L,
                                     0.236926885056189087514L};
  const auto integrand = [&](long double w) {
    const long double log_ratio = -std::log1p(-w * w) - m * w * w / r0;  // ln(n r / b)
    return 2.0L * w / (1.0L - w * w) / std::sqrt(std::expm1(2.0L * log_ratio));
  };
  const int cells = 2000;
  const long double h = end / cells;
  long double sum = 0.0L;
  for (int i = 0; i < cells; ++i) {
    const long double middle = (static_cast<long double>(i) + 0.5L) * h;
    sum += weight[0] * integrand(middle);
    for (int k = 1; k < 3; ++k)
      sum +=
          weight[k] * (integrand(middle - node[k] * h / 2) + integrand(middle + node[k] * h / 2));
  }
  return sum * h / 2;
}

/// Total turning of a photon that comes from outside the influence (or from infinity) and leaves.
inline double total_turning(double m, double influence, double b) {
  const long double swept = 2.0L * azimuth(m, turning_point(m, influence, b), influence);
  const long double straight = std::isinf(influence)
                                   ? std::numbers::pi_v<long double>
                                   : std::numbers::pi_v<long double> -
                                         2.0L * std::asin(static_cast<long double>(b) / influence);
  return static_cast<double>(swept - straight);
}

/// Turning of a photon that starts at (x, y), x < 0, flying along +x, in an infinite influence
/// round the origin, until it has left for infinity.
inline double turning_from(double m, double x, double y) {
  const long double r = std::hypot(static_cast<long double>(x), static_cast<long double>(y));
  const long double b = std::exp(m / r) * y;  // n r sin(angle to the radius)
  const long double r0 = turning_point(m, infinite, b);
  const long double swept = azimuth(m, r0, infinite) + azimuth(m, r0, r);
  return static_cast<double>(swept -
                             std::atan2(static_cast<long double>(y), static_cast<long double>(x)));
}

}  // namespace portalens::closed_form
