/// \file
/// `law = "einstein"`: twice the pull of the paper, as general relativity has it to first order.
/// The metric -e^(-2w) dt² + e^(2w) dx²; equations.md, sec. 1.
#pragma once

#include <cmath>
#include <string_view>

namespace portalens {

struct EinsteinLaw {
  static constexpr std::string_view name = "einstein";
  static constexpr bool uniform = true;
  static constexpr bool bare_masses = true;

  template <class Real>
  [[nodiscard]] static Real weight(Real) {
    return Real(2.0);
  }
  [[nodiscard]] static double log_index(double w) { return 2.0 * w; }
  [[nodiscard]] static double clock(double w) { return std::exp(-w); }
  /// There is none: what comes within 2 m, where light can circle, falls in.
  [[nodiscard]] static double horizon_radius(double m, double) { return 2.0 * m; }
};

}  // namespace portalens
