/// \file
/// `law = "schwarzschild"`: general relativity's own, exact for one mass, in isotropic coordinates;
/// equations.md, sec. 1. Of several masses it takes the sum in w: each alone is exact, and so is
/// the far field to first order; no static solution of several holes exists.
///
///     n = (1 + w/2)³ / (1 - w/2)      horizon at w = 2, where n is infinite and the path is smooth
#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>

namespace portalens {

struct SchwarzschildLaw {
  static constexpr std::string_view name = "schwarzschild";
  static constexpr bool uniform = false;
  static constexpr bool bare_masses = false;
  /// Just short of the horizon: what comes there never leaves.
  static constexpr double greatest_potential = 1.98;

  template <class Real>
  [[nodiscard]] static Real weight(Real w) {
    using std::min;
    const Real u = min(w, Real(greatest_potential)) * Real(0.5);
    return (Real(2.0) - u) / (Real(1.0) - u * u);
  }
  template <class Real>
  [[nodiscard]] static Real weight_slope(Real w) {
    using std::min;
    const Real u = min(w, Real(greatest_potential)) * Real(0.5);
    const Real rest = Real(1.0) - u * u;
    return (Real(2.0) * u - Real(0.5) * (Real(1.0) + u * u)) / (rest * rest);
  }
  [[nodiscard]] static double log_index(double w) {
    return 3.0 * std::log1p(0.5 * w) - std::log1p(-0.5 * w);
  }
  [[nodiscard]] static double clock(double w) { return (2.0 - w) / (2.0 + w); }
  /// Of one mass exactly. Where horizons merge it is not far from the common one.
  [[nodiscard]] static double horizon_radius(double m, double w) {
    return m / std::fmax(greatest_potential - w, 0.5 * greatest_potential);
  }
};

}  // namespace portalens
