/// \file
/// A mass, with the radii that follow from it. Dunigan & Pianta, sec. 5; equations.md, sec. 2.
#pragma once

#include <cmath>
#include <limits>
#include <string>

#include "math/vec3.h"

namespace portalens {

/// @param gm  G·M, length³/time², >= 0
/// @param c   speed of light, length/time, > 0
/// @return m = G M / c², length
[[nodiscard]] inline double gravitational_radius(double gm, double c) { return gm / (c * c); }

/// @return r_s = 2 G M / c², length
[[nodiscard]] inline double schwarzschild_radius(double gm, double c) {
  return 2.0 * gravitational_radius(gm, c);
}

/// Distance at which a mass pulls a photon with acceleration `threshold`: R = sqrt(G M / f).
/// @param threshold  length/time², >= 0; 0 makes the influence infinite
[[nodiscard]] inline double influence_radius(double gm, double threshold) {
  if (gm == 0.0) return 0.0;
  return threshold > 0.0 ? std::sqrt(gm / threshold) : std::numeric_limits<double>::infinity();
}

struct Mass {
  std::string name;
  Vec3d center;
  double gm = 0.0;      ///< G M
  double core = 0.0;    ///< Plummer's core radius a
  bool horizon = true;  ///< a photon within `horizon_radius` of the centre is absorbed
  /// Where light ends: r_s under the paper's law (`set_horizons` for others).
  double horizon_radius = 0.0;
  double influence = 0.0;  ///< R; infinite if the threshold is 0

  [[nodiscard]] bool has_horizon() const { return horizon && gm > 0.0; }
  /// Whether it acts there.
  [[nodiscard]] bool reaches(Vec3d x) const {
    const Vec3d to = center - x;
    return dot(to, to) < influence * influence;
  }
  /// G M / √(d² + a²)
  [[nodiscard]] double potential(Vec3d x) const {
    const Vec3d to = center - x;
    return gm / std::sqrt(dot(to, to) + core * core);
  }
};

}  // namespace portalens
