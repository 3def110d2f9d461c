/// \file
/// The formulas of `shortest-path` over one face, for `double` and for packs of lanes.
#pragma once

#include <algorithm>
#include <cmath>

#include "math/vec3.h"

namespace portalens {

/// What a pack's lanes choose, for one number.

/// Two ends beside a line, each by its coordinate along the line and its distance from it.
template <class Real>
struct BesideLine {
  Real along_a, off_a, along_b, off_b;

  /// Where the shortest path from a to b over the line meets it: with both turned about it into one
  /// plane, on opposite sides, the path is straight.
  [[nodiscard]] Real meeting() const {
    const Real off = off_a + off_b;
    return select(off > Real(0), (along_a * off_b + along_b * off_a) / off, along_a);
  }
};

/// The shortest path over a piece of the line, from 0 to `size`: its length, and where it meets it.
template <class Real>
struct RimWay {
  Real length, place;
};

template <class Real>
[[nodiscard]] RimWay<Real> over_rim(const BesideLine<Real>& ends, Real size) {
  using std::max, std::min, std::sqrt;
  const Real place = min(max(ends.meeting(), Real(0)), size);
  const Real to_a = place - ends.along_a, to_b = place - ends.along_b;
  return {sqrt(ends.off_a * ends.off_a + to_a * to_a) + sqrt(ends.off_b * ends.off_b + to_b * to_b),
          place};
}

/// G M D u / (D² + a²)^(3/2) as what multiplies `ahead`, a vector along u: u = ahead / near.
/// @param square  D² + a², > 0
/// @param near2   the square of the length of `ahead`, > 0
template <class Real>
[[nodiscard]] Real way_pull(Real gm, Real length, Real square, Real near2) {
  using std::sqrt;
  return gm * length / (square * sqrt(square) * sqrt(near2));
}

/// The square of the length over which what comes along a path varies. Beside a rim its direction
/// turns within the distance to it. Not resolved closer than a thousandth of the path: what that
/// leaves out is as small a share of the pull.
template <class Real, class Mask>
[[nodiscard]] Real way_scale2(Mask straight, Real square, Real near2) {
  using std::max;
  return select(straight, square, max(near2, Real(1e-6) * square));
}

}  // namespace portalens
