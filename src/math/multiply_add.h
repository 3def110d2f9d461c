/// \file
/// a b + c and c - a b, of numbers and of vectors. For `double` they round twice, as written; packs
/// of lanes have those that round once (math/pack.h).
#pragma once

#include "math/vec3.h"

namespace portalens {

[[nodiscard]] constexpr double multiply_add(double a, double b, double c) { return a * b + c; }
[[nodiscard]] constexpr double subtract_product(double c, double a, double b) { return c - a * b; }

template <class Real>
[[nodiscard]] constexpr Vec3<Real> multiply_add(Vec3<Real> a, Real s, Vec3<Real> c) {
  return {multiply_add(a.x, s, c.x), multiply_add(a.y, s, c.y), multiply_add(a.z, s, c.z)};
}
template <class Real>
[[nodiscard]] constexpr Vec3<Real> subtract_product(Vec3<Real> c, Vec3<Real> a, Real s) {
  return {subtract_product(c.x, a.x, s), subtract_product(c.y, a.y, s),
          subtract_product(c.z, a.z, s)};
}

}  // namespace portalens
