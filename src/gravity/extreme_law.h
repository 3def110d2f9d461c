/// \file
/// `law = "extreme"`: holes whose electric charge holds them apart, Q = M, at rest (Majumdar and
/// Papapetrou): exact for any number of them; equations.md, sec. 1.
///
///     n = (1 + w)²
#pragma once

#include <cmath>
#include <string_view>

namespace portalens {

struct ExtremeLaw {
  static constexpr std::string_view name = "extreme";
  static constexpr bool uniform = false;
  static constexpr bool bare_masses = false;

  template <class Real>
  [[nodiscard]] static Real weight(Real w) {
    return Real(2.0) / (Real(1.0) + w);
  }
  template <class Real>
  [[nodiscard]] static Real weight_slope(Real w) {
    const Real weight = Real(1.0) / (Real(1.0) + w);
    return -(Real(2.0) * weight * weight);
  }
  [[nodiscard]] static double log_index(double w) { return 2.0 * std::log1p(w); }
  [[nodiscard]] static double clock(double w) { return 1.0 / (1.0 + w); }
  /// The horizon is the point itself; what comes within half of m/U never leaves, with
  /// U = 1 + Σ m/d of all other masses.
  [[nodiscard]] static double horizon_radius(double m, double w) { return 0.01 * m / (1.0 + w); }
};

}  // namespace portalens
