/// \file
/// Over lanes: what one mass adds to the bending of light.
#pragma once

#include "gravity/attraction.h"
#include "gravity/law.h"
#include "lanes/scene.h"
#include "math/multiply_add.h"
#include "math/vec3.h"

namespace portalens {

/// Adds what a mass does to a path: nothing where `m` is 0.
/// @param square, along  of the path to it: its square, and its part along the path of light
/// @param m  G M / c² where it acts
template <class R>
void add_bending(BendingOf<R>& sum, const LaneMass& mass, Vec3<R> to_mass, R square, R along, R m) {
  add_bending(sum, to_mass, square + R(mass.core2), along, m, R(mass.gm * mass.gm));
}

/// The same of one that counts `weight` times.
template <class R>
void add_weighted_bending(BendingOf<R>& sum, const LaneMass& mass, Vec3<R> to_mass, R square,
                          R along, R m, R weight) {
  const R own = R(mass.gm) * weight;
  add_bending(sum, to_mass, square + R(mass.core2), along, m * weight, own * own);
}

/// Adds its acceleration of what is `to_mass` from it, and tells its m/d there.
template <class R>
R add_pull(Vec3<R>& sum, const LaneMass& mass, Vec3<R> to_mass, R m) {
  const R q = dot(to_mass, to_mass) + R(mass.core2);
  const MassPull<R> pull = MassPull<R>::of(q, m);
  sum = multiply_add(to_mass, pull.pull, sum);
  return m * pull.inverse;
}

}  // namespace portalens
