/// \file
/// The path of one step as a polynomial in arc length.
#pragma once

#include <algorithm>
#include <cmath>

#include "math/vec3.h"

namespace portalens {

/// Quintic Hermite interpolation of position, direction and curvature vector at both ends of a
/// step: as exact as the steps of a fourth-order method, and straight where the ends agree that it
/// is.
class Curve {
 public:
  /// A straight step.
  Curve(Vec3d position, Vec3d direction, double length)
      : start_(position), c1_(direction * length), length_(length) {}

  /// @param x0,t0,a0  position, unit direction, dt/ds at the start; x1,t1,a1 at the end
  /// @param middle    |dt/ds| halfway
  /// @param length    arc length of the step, > 0
  Curve(Vec3d x0, Vec3d t0, Vec3d a0, Vec3d x1, Vec3d t1, Vec3d a1, double middle, double length)
      : start_(x0),
        c1_(t0 * length),
        length_(length),
        bend_{portalens::length(a0), middle, portalens::length(a1)} {
    const Vec3d half_bend = a0 * (0.5 * length * length);
    const Vec3d d = x1 - x0 - c1_ - half_bend;
    const Vec3d e = (t1 - t0) * length - half_bend * 2.0;
    const Vec3d f = (a1 - a0) * (length * length);
    c2_ = half_bend;
    c3_ = d * 10.0 - e * 4.0 + f * 0.5;
    c4_ = d * -15.0 + e * 7.0 - f;
    c5_ = d * 6.0 - e * 3.0 + f * 0.5;
  }

  /// As Σ c[k] uᵏ, u being the share of its length.
  /// @param bend  |dt/ds|, at the most
  Curve(const Vec3d (&c)[6], double bend, double length)
      : start_(c[0]),
        c1_(c[1]),
        c2_(c[2]),
        c3_(c[3]),
        c4_(c[4]),
        c5_(c[5]),
        length_(length),
        bend_{bend, bend, bend} {}

  [[nodiscard]] double length() const { return length_; }

  [[nodiscard]] Vec3d position(double s) const {
    const double u = s / length_;
    return start_ + (c1_ + (c2_ + (c3_ + (c4_ + c5_ * u) * u) * u) * u) * u;
  }

  /// Unit direction.
  [[nodiscard]] Vec3d direction(double s) const {
    const double u = s / length_;
    return normalize(c1_ + (c2_ * 2.0 + (c3_ * 3.0 + (c4_ * 4.0 + c5_ * (5.0 * u)) * u) * u) * u);
  }

  /// How far the curve can be from the chord of a piece of it that is `piece` long.
  [[nodiscard]] double sagitta(double piece) const {
    return 1.5 * std::max({bend_[0], bend_[1], bend_[2]}) * piece * piece / 8.0;
  }

  /// ∫ |dt/ds| ds from the start to `s`: Gauss's three points on the polynomial; on a step so short
  /// that its second derivative would be rounding, the parabola through the bends at the start, the
  /// middle and the end.
  [[nodiscard]] double turning(double s) const {
    if (length_ < 2e-5 * portalens::length(start_)) {
      const double u = s / length_;
      const double slope = -3.0 * bend_[0] + 4.0 * bend_[1] - bend_[2];
      const double square = 2.0 * (bend_[0] - 2.0 * bend_[1] + bend_[2]);
      return std::fmax(0.0, s * (bend_[0] + u * (slope / 2.0 + u * square / 3.0)));
    }
    const double u = 0.5 * s / length_, offset = u * 0.7745966692414834;
    return (5.0 * (curvature(u - offset) + curvature(u + offset)) + 8.0 * curvature(u)) * s / 18.0;
  }

 private:
  /// |d²x/ds²| at the share `u` of the step.
  [[nodiscard]] double curvature(double u) const {
    const Vec3d second = c2_ * 2.0 + (c3_ * 6.0 + (c4_ * 12.0 + c5_ * (20.0 * u)) * u) * u;
    return portalens::length(second) / (length_ * length_);
  }

  Vec3d start_, c1_, c2_, c3_, c4_, c5_;
  double length_;
  double bend_[3] = {0.0, 0.0, 0.0};
};

}  // namespace portalens
