/// \file
/// Over lanes: what one mass adds to the bending of light.
#pragma once

#include "gravity/attraction.h"
#include "lanes/rectangle.h"
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

/// Adds its acceleration of what is `to_mass` from it.
template <class R>
void add_pull(Vec3<R>& sum, const LaneMass& mass, Vec3<R> to_mass, R m) {
  const R q = dot(to_mass, to_mass) + R(mass.core2);
  sum = multiply_add(to_mass, MassPull<R>::of(q, m).pull, sum);
}

}  // namespace portalens
