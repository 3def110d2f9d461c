/// \file
/// The look-up of `graviton-map`, for `double` and for packs of lanes.
#pragma once

namespace portalens {

/// Between four corners of a cell, at the shares u and v of its sides.
/// @param a, b  at v = 0: u = 0 and 1; c, d at v = 1
template <class Value, class Real>
[[nodiscard]] Value bilinear(Value a, Value b, Value c, Value d, Real u, Real v) {
  const Real rest_u = Real(1.0) - u, rest_v = Real(1.0) - v;
  return (a * rest_u + b * u) * rest_v + (c * rest_u + d * u) * v;
}

}  // namespace portalens
