/// \file
/// Over lanes: what one mass adds to the bending of light.
#pragma once

#include "gravity/attraction.h"
#include "lanes/rectangle.h"
#include "lanes/scene.h"
#include "math/multiply_add.h"
#include "math/vec3.h"

namespace portalens {

template <class R>
struct LaneBending {
  Vec3<R> acceleration;
  R stiffness, nearness;
  R gradient;  ///< how much the acceleration differs by, over the distance, 1/length²
};

template <class R>
struct LanePull {
  R inverse, inverse2, pull;  ///< 1/d, 1/d² and m/d³

  /// @param d2  with the square of the core's radius
  [[nodiscard]] static LanePull of(R d2, R gm) {
    const R inverse = inverse_sqrt(d2);
    const R inverse2 = inverse * inverse;
    return {inverse, inverse2, gm * inverse2 * inverse};
  }
};

/// Adds what a mass does to a path: nothing where `gm` is 0.
/// @param square, along  of the path to it: its square, and its part along the path of light
template <class R>
void add_bending(LaneBending<R>& sum, const LaneMass& mass, Vec3<R> to_mass, R square, R along,
                 R gm) {
  const R core2(mass.core2), m2(mass.gm * mass.gm);
  const R b2 = subtract_product(square + core2, along, along);
  const LanePull<R> pull = LanePull<R>::of(square + core2, gm);
  sum.acceleration = multiply_add(to_mass, pull.pull, sum.acceleration);
  sum.stiffness =
      multiply_add(pull.pull * pull.inverse2, path_weight(m2, max(b2, R(0))), sum.stiffness);
  const R nearness = multiply_add(pull.inverse2 * pull.inverse2,
                                  approach_weight(along * pull.inverse), sum.nearness);
  sum.nearness = select(gm > R(0), nearness, sum.nearness);
  sum.gradient = multiply_add(R(2), pull.pull, sum.gradient);
}

/// Adds its acceleration of what is `to_mass` from it.
template <class R>
void add_pull(Vec3<R>& sum, const LaneMass& mass, Vec3<R> to_mass, R gm) {
  const R d2 = dot(to_mass, to_mass) + R(mass.core2);
  sum = multiply_add(to_mass, LanePull<R>::of(d2, gm).pull, sum);
}

}  // namespace portalens
