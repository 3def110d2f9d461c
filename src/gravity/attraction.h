/// \file
/// The pull of one mass. Dunigan & Pianta, sec. 5, with Plummer's core.
#pragma once

#include "math/multiply_add.h"

namespace portalens {

/// G M (p - x) / (d² + a²)^(3/2), for x nearer than the influence; the caller decides whether it
/// is.
/// @param to_mass  p - x
/// @param gm       G·M
/// @param core2    a²
/// @pre d² + a² > 0
template <class Real>
[[nodiscard]] Vec3<Real> attraction(Vec3<Real> to_mass, Real gm, Real core2) {
  using std::sqrt;
  const Real q = dot(to_mass, to_mass) + core2;
  return to_mass * (gm / (q * sqrt(q)));
}

/// How much closer than elsewhere a path must be followed that would pass a mass at the distance b
/// if it were straight: near capture it magnifies every error made on the path. Measured, for steps
/// that ignore b, as the error at the end over b/m.
/// @param m2  square of the gravitational radius, b2  of the distance b
template <class Real>
[[nodiscard]] Real path_weight(Real m2, Real b2) {
  return Real(0.1) + Real(10.0) * m2 / (b2 + Real(2.0) * m2);
}

/// How much a mass's nearness shortens steps, by the cosine of the angle between the path and the
/// path to it: a step away from a mass sees its field change the less the longer it is, one towards
/// it the more. It is 1 straight towards it, and lets a step across be 1.4 times as long, one away
/// 2.5 times. Measured on pictures of one and of three masses: a sixth fewer steps, for errors
/// that are up to twice as large and far below the tolerance.
template <class Real>
[[nodiscard]] Real approach_weight(Real cosine) {
  const Real share = multiply_add(Real(0.3), cosine, Real(0.7));
  return (share * share) * (share * share);
}

/// Stands for `path_weight` where a mass acts through a portal: light can't come near it.
inline constexpr double distant_weight = 0.3;

}  // namespace portalens
