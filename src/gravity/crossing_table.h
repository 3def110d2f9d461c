/// \file
/// What one mass does to a photon that crosses its influence where nothing else is, by table.
/// equations.md, sec. 3.
///
/// With the impact parameter b, n r sin(angle to the radius) = b all the way (Bouguer). So a photon
/// leaves the ball of radius R at the angle to the radius at which it entered, turned by α(b) in
/// its plane; or, for b < b_c = 2 m exp(1/2 - m/R), it meets the horizon at an angle with the sine
/// b/b_c. What is left to know is α(b) and the length of the path.
#pragma once

#include <vector>

#include "gravity/crossing_formulas.h"

namespace portalens {

struct Crossing {
  double half_tangent;  ///< tan(α/2)
  double turning;       ///< α, radians
  double length;        ///< of the path, from the rim to the rim or to the horizon, in units of R
};

/// By quadrature, to about 1e-10.
/// @param share  m/R, above 0 and below 0.45, so that the horizon lies within the influence
/// @param b  in units of R, 0 < b < 1
[[nodiscard]] Crossing exact_crossing(double share, double b);

/// The radius of the closest approach of a photon that is not captured, in units of R.
[[nodiscard]] double closest_approach(double share, double b);

/// Of one share m/R. Immutable.
class CrossingTable {
 public:
  /// @param share  as for `exact_crossing`
  explicit CrossingTable(double share);

  [[nodiscard]] double share() const { return share_; }
  [[nodiscard]] const CrossingRange<double>& range() const { return range_; }
  /// `floats_per_cell` for each cell.
  [[nodiscard]] const std::vector<float>& cells() const { return cells_; }

  /// @param b  in units of R, 0 <= b <= 1; below b_c until the horizon
  [[nodiscard]] Crossing at(double b) const;

  /// How far `at` is off at most, in α (radians) and in the length (units of R): twice what is
  /// found where a cubic through its four nodes of a cell is worst.
  [[nodiscard]] double angle_error() const { return angle_error_; }
  [[nodiscard]] double length_error() const { return length_error_; }

 private:
  [[nodiscard]] double impact_of(int cell, double within) const;
  [[nodiscard]] Crossing exact_at(int cell, double b) const;
  void fill(int cell);
  void measure(int cell, double within);

  double share_;
  CrossingRange<double> range_;
  std::vector<float> cells_;
  double angle_error_ = 0.0, length_error_ = 0.0;
};

}  // namespace portalens
