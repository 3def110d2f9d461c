/// \file
/// `law = "newton"`: light falls as a slow body does, half as far as in general relativity. Dunigan
/// & Pianta, sec. 5; the metric -e^(-2w) dt² + dx², Einstein's value of 1911.
#pragma once

#include <cmath>
#include <string_view>

namespace portalens {

struct NewtonLaw {
  static constexpr std::string_view name = "newton";
  static constexpr bool uniform = true;
  static constexpr bool bare_masses = true;

  template <class Real>
  [[nodiscard]] static Real weight(Real) {
    return Real(1.0);
  }
  [[nodiscard]] static double log_index(double w) { return w; }
  [[nodiscard]] static double clock(double w) { return std::exp(-w); }
  [[nodiscard]] static double horizon_radius(double m, double) { return 2.0 * m; }
};

}  // namespace portalens
