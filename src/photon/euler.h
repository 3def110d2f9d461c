/// \file
/// The paper's step: semi-implicit Euler. Dunigan & Pianta, sec. 5.
#pragma once

#include "photon/integrator_settings.h"
#include "photon/step.h"

namespace portalens {

/// v += g_perp Δt, rescaled to c; x += v Δt. Order 1; the path is a chain of straight pieces.
struct Euler {
  static constexpr std::string_view name = "euler";
  static constexpr bool fixed_step = true;
  static constexpr bool straight_pieces = true;
  double length;

  static Euler from(const IntegratorSettings& settings) { return {settings.step}; }

  /// @param acceleration  g/c² as a function of position
  template <class Acceleration>
  [[nodiscard]] static StepResult<double> step(const Acceleration&, State state,
                                               Vec3d start_acceleration, double h) {
    const Vec3d turned =
        normalize(state.direction + turning_part(start_acceleration, state.direction) * h);
    return {{state.position + turned * h, turned}, 0.0};
  }
};

}  // namespace portalens
