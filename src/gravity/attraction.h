/// \file
/// The pull of one mass, and what steps are chosen by, for `double` and for packs of lanes. Dunigan
/// & Pianta, sec. 5, with Plummer's core.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

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
  return Real(0.1) + Real(10.4) * m2 / (b2 + Real(2.0) * m2);
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

/// How much it shortens steps that the nearest point of a curved rim, through which a mass acts, is
/// about to swing round: a step that is long against the way to the rim's centre of curvature would
/// look at the field before and after, and miss when it changes. Measured on random scenes
/// (docs/differential.md).
inline constexpr double swing_weight = 20.0;

/// Of one mass, at the distance d, with its core.
template <class Real>
struct MassPull {
  Real inverse, inverse2, pull;  ///< 1/d, 1/d² and m/d³

  /// @param q  d²
  /// @param m  G M / c²
  [[nodiscard]] static MassPull of(Real q, Real m) {
    if constexpr (std::is_same_v<Real, double>) {
      const double inverse2 = 1.0 / q, inverse = std::sqrt(inverse2);
      return {inverse, inverse2, m * inverse2 * inverse};
    } else {
      const Real inverse = inverse_sqrt(q), inverse2 = inverse * inverse;
      return {inverse, inverse2, m * inverse2 * inverse};
    }
  }
};

/// What bends light at a place, and the sums from which a step is chosen and judged. Under a law
/// whose weight is h, each m counts h times.
template <class Real>
struct BendingOf {
  Vec3<Real> acceleration{};  ///< 1/length: dt/ds before its part along t is removed
  Real stiffness{};           ///< Σ w m / d⁵ with w = path_weight, 1/length⁴
  Real nearness{};            ///< Σ v / d⁴ with v = approach_weight, 1/length⁴
  Real gradient{};            ///< Σ 2 m / d³, of the acceleration, 1/length²
  Real shear{};               ///< Σ m |3 b²/d² - 1| / d³, of that across the path, 1/length²
  Real sinking{};             ///< 1 where light is lost (`sinks`), else 0
};
using Bending = BendingOf<double>;

/// Where light falls to a mass so deep that it never returns, under laws that let it come there:
/// about one mass where h m/d > 4/3 and it goes inwards (light circles it at 1; the rest is for
/// others beside it). There n r grows inwards, and the errors of a path shrink (Bouguer).
/// @param bending  without the change of the weight
template <class Real>
[[nodiscard]] auto sinks(const BendingOf<Real>& bending, Vec3<Real> direction) {
  const Vec3<Real> a = bending.acceleration;
  return both(dot(a, a) * Real(1.5) > bending.gradient, dot(a, direction) > Real(0));
}

/// Adds a gradient that may lie in any direction.
template <class Real>
void add_gradient(BendingOf<Real>& sum, Real gradient) {
  sum.gradient = sum.gradient + gradient;
  sum.shear = sum.shear + gradient;
}

/// Adds what a mass does to a path: nothing where `m` is 0.
/// @param q      d² of the path to it, with its core; `along` that way's part along the path of
/// light
/// @param m, m2  G M / c², and its square where m is not 0
template <class Real>
void add_bending(BendingOf<Real>& sum, Vec3<Real> to_mass, Real q, Real along, Real m, Real m2) {
  using std::abs, std::max;
  const Real b2 = subtract_product(q, along, along);
  const MassPull<Real> pull = MassPull<Real>::of(q, m);
  sum.acceleration = multiply_add(to_mass, pull.pull, sum.acceleration);
  sum.stiffness =
      multiply_add(pull.pull * pull.inverse2, path_weight(m2, max(b2, Real(0))), sum.stiffness);
  const Real nearness = multiply_add(pull.inverse2 * pull.inverse2,
                                     approach_weight(along * pull.inverse), sum.nearness);
  sum.nearness = select(m > Real(0), nearness, sum.nearness);
  sum.gradient = multiply_add(Real(2), pull.pull, sum.gradient);
  sum.shear =
      multiply_add(pull.pull, abs(multiply_add(b2 * pull.inverse2, Real(3), Real(-1))), sum.shear);
}

}  // namespace portalens
