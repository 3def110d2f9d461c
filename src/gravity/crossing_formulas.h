/// \file
/// Where a `CrossingTable` holds what belongs to an impact parameter, for `double` and for packs of
/// lanes.
#pragma once

#include <algorithm>
#include <cmath>

namespace portalens {

/// The cells of a table: first those of paths that end on the horizon, then those of the others.
inline constexpr int captured_cells = 24;
inline constexpr int passing_cells = 104;
/// Of each cell: four coefficients, the constant first, each of tan(α/2), α, the length, and 0.
inline constexpr int floats_per_cell = 16;

/// Where the paths of one mass's table lie. Lengths are in radii of influence.
template <class Real>
struct CrossingRange {
  Real capture;  ///< b_c
  Real scale;    ///< length over which passing paths change near capture
  Real stretch;  ///< cells per step of (1 + (b - b_c) / scale)^(-1/2)
};

/// Cells are counted with the share of the last; tan(α/2) and α are the table's times `factor`.
template <class Real>
struct CrossingPlace {
  Real cell, factor;
};

/// Of a path that meets the horizon, at an angle whose sine is b/b_c.
/// @pre b <= b_c
template <class Real>
[[nodiscard]] CrossingPlace<Real> captured_place(const CrossingRange<Real>& range, Real b) {
  using std::max;
  using std::sqrt;
  const Real sine = b / range.capture;
  const Real cosine2 = (Real(1.0) - sine) * (Real(1.0) + sine);
  return {sqrt(max(cosine2, Real(0.0))) * Real(captured_cells), sine};
}

/// Of a path that leaves the influence. The cells are fine near capture, and far out equal steps of
/// 1/√b: there α is nearly 2 m/b times the cosine of the angle to the radius at the rim.
/// @param cosine  that one; the length, too, is the table's times it
template <class Real>
[[nodiscard]] CrossingPlace<Real> passing_place(const CrossingRange<Real>& range, Real b,
                                                Real cosine) {
  using std::sqrt;
  const Real root = Real(1.0) / sqrt(Real(1.0) + (b - range.capture) / range.scale);
  return {Real(captured_cells) + (Real(1.0) - root) * range.stretch, cosine};
}

}  // namespace portalens
