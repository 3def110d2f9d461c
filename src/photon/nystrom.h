/// \file
/// The default: a fourth-order Nyström step whose length follows from the field.
#pragma once

#include <algorithm>
#include <cmath>

#include "photon/integrator_settings.h"
#include "photon/step.h"

namespace portalens {

/// Nyström's fourth-order method for x'' = a(x, x'): three evaluations of the field a step, since
/// the second and third stage share a position. Order 4. No step is ever rejected for its error:
/// the error of a step of h at distance d from a mass goes as (m/d) (h/d)⁴ h/d, so steps of
///     h = (Σ m d⁻⁵ / η⁴ + Σ d⁻⁴ / λ⁴)^(-1/4)
/// spread it evenly over the path; the second sum keeps a step shorter than λ times the distance.
struct Nystrom {
  static constexpr std::string_view name = "adaptive";
  static constexpr bool fixed_step = false;
  static constexpr bool straight_pieces = false;
  double stiffness_weight;  ///< 1/η⁴
  double nearness_weight;   ///< 1/λ⁴

  static Nystrom from(const IntegratorSettings& settings) {
    return {1.0 / (error_share * settings.tolerance), 1.0 / std::pow(longest_share, 4)};
  }

  /// @param stiffness  Σ m d⁻⁵, nearness  Σ d⁻⁴, both 1/length⁴
  [[nodiscard]] double propose(double stiffness, double nearness) const {
    return 1.0 / std::sqrt(std::sqrt(stiffness * stiffness_weight + nearness * nearness_weight));
  }

  template <class Acceleration>
  [[nodiscard]] static StepResult step(const Acceleration& acceleration, State state,
                                       Vec3d start_acceleration, double h) {
    const Vec3d x = state.position, t = state.direction;
    const Vec3d k1 = turning_part(start_acceleration, t);
    const Vec3d middle = acceleration(x + t * (h / 2) + k1 * (h * h / 8));
    const Vec3d k2 = turning_part(middle, t + k1 * (h / 2));
    const Vec3d k3 = turning_part(middle, t + k2 * (h / 2));
    const Vec3d k4 = turning_part(acceleration(x + t * h + k3 * (h * h / 2)), t + k3 * h);
    return {{x + t * h + (k1 + k2 + k3) * (h * h / 6),
             normalize(t + (k1 + (k2 + k3) * 2.0 + k4) * (h / 6))},
            portalens::length(k2)};
  }

  /// η⁴ as a share of the tolerance, and λ: measured against the closed forms of one mass from near
  /// capture to far (tests/photon/closed_forms_test.cpp holds them to it).
  static constexpr double error_share = 0.3;
  static constexpr double longest_share = 0.5;
};

}  // namespace portalens
