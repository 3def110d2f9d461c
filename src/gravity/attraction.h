/// \file
/// The pull of one mass. Dunigan & Pianta, sec. 5, with Plummer's core.
#pragma once

#include "math/vec3.h"

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

}  // namespace portalens
