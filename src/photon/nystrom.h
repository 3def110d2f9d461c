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
///     h = (Σ w m d⁻⁵ / η⁴ + Σ d⁻⁴ / λ⁴)^(-1/4)
/// spread it evenly over the path; the second sum keeps a step shorter than λ times the distance.
/// Near capture a path magnifies every error made on the way: hence the weight w, `path_weight`.
struct Nystrom {
  static constexpr std::string_view name = "adaptive";
  static constexpr bool fixed_step = false;
  static constexpr bool straight_pieces = false;
  double stiffness_weight;  ///< 1/η⁴
  double nearness_weight;   ///< 1/λ⁴

  static Nystrom from(const IntegratorSettings& settings) {
    return {1.0 / (error_share * settings.tolerance), 1.0 / std::pow(longest_share, 4)};
  }

  /// @param stiffness  Σ w m d⁻⁵, nearness  Σ d⁻⁴, both 1/length⁴
  template <class Real>
  [[nodiscard]] static Real propose(Real stiffness, Real nearness, Real stiffness_weight,
                                    Real nearness_weight) {
    return inverse_fourth_root(stiffness * stiffness_weight + nearness * nearness_weight);
  }
  [[nodiscard]] double propose(double stiffness, double nearness) const {
    return propose(stiffness, nearness, stiffness_weight, nearness_weight);
  }

  template <class Real, class Acceleration>
  [[nodiscard]] static StepResult<Real> step(const Acceleration& acceleration, StateOf<Real> state,
                                             Vec3<Real> start_acceleration, Real h) {
    const Vec3<Real> x = state.position, t = state.direction;
    const Real half = h * Real(0.5);
    const Vec3<Real> k1 = turning_part(start_acceleration, t);
    const Vec3<Real> middle = acceleration(x + t * half + k1 * (half * half * Real(0.5)));
    const Vec3<Real> k2 = turning_part(middle, t + k1 * half);
    const Vec3<Real> k3 = turning_part(middle, t + k2 * half);
    const Vec3<Real> k4 = turning_part(acceleration(x + (t + k3 * half) * h), t + k3 * h);
    const Real sixth = h * Real(1.0 / 6.0);
    return {{x + (t + (k1 + k2 + k3) * sixth) * h,
             normalize(t + (k1 + (k2 + k3) * Real(2.0) + k4) * sixth)},
            portalens::length(k2)};
  }

  /// η⁴ as a share of the tolerance, and λ: measured against the closed forms of one mass from near
  /// capture to far (tests/photon/closed_forms_test.cpp holds them to it).
  static constexpr double error_share = 0.3;
  static constexpr double longest_share = 0.5;
};

}  // namespace portalens
