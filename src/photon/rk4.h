/// \file
/// The classical fourth-order Runge-Kutta step, which the paper tried and set aside.
#pragma once

#include "photon/integrator_settings.h"
#include "photon/step.h"

namespace portalens {

/// Order 4, four evaluations of the field; the direction is rescaled to length 1 after the step.
struct Rk4 {
  static constexpr std::string_view name = "rk4";
  static constexpr bool fixed_step = true;
  static constexpr bool straight_pieces = false;
  double length;

  static Rk4 from(const IntegratorSettings& settings) { return {settings.step}; }

  template <class Acceleration>
  [[nodiscard]] static StepResult<double> step(const Acceleration& acceleration, State state,
                                               Vec3d start_acceleration, double h) {
    const Vec3d x = state.position, t = state.direction;
    const Vec3d a1 = turning_part(start_acceleration, t);
    const Vec3d t2 = t + a1 * (h / 2);
    const Vec3d a2 = turning_part(acceleration(x + t * (h / 2)), t2);
    const Vec3d t3 = t + a2 * (h / 2);
    const Vec3d a3 = turning_part(acceleration(x + t2 * (h / 2)), t3);
    const Vec3d t4 = t + a3 * h;
    const Vec3d a4 = turning_part(acceleration(x + t3 * h), t4);
    return {{x + (t + (t2 + t3) * 2.0 + t4) * (h / 6),
             normalize(t + (a1 + (a2 + a3) * 2.0 + a4) * (h / 6))},
            portalens::length(a2)};
  }
};

}  // namespace portalens
