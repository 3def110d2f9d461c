/// \file
/// Over lanes: how far it is along a way to a plane or a sphere.
#pragma once

#include "math/multiply_add.h"

namespace portalens {

/// A length that no way comes to.
inline constexpr float never = 1e30f;

/// When height `a` that changes at rate `v` reaches 0, or `never`.
template <class R>
[[nodiscard]] R until_zero(R a, R v) {
  const R s = -a / v;
  return select((s > R(0)) & (abs(v) > R(1e-12)), s, R(never));
}

/// The plane that a way comes to first. It starts at some height over each, which changes at a
/// rate, and that at a rate of its own.
template <class R>
struct FirstPlane {
  R at{never}, rate{1}, turn{0};

  void offer(R height, R its_rate, R its_turn) {
    const R s = until_zero(height, its_rate);
    const auto sooner = s < at;
    at = select(sooner, s, at);
    rate = select(sooner, its_rate, rate);
    turn = select(sooner, its_turn, turn);
  }
  void take(typename R::Mask where, const FirstPlane& other) {
    at = select(where, other.at, at);
    rate = select(where, other.rate, rate);
    turn = select(where, other.turn, turn);
  }
  /// By one step of Newton's method from the straight way.
  [[nodiscard]] R along_the_curve() const {
    const R better = at - at * at * turn * R(0.5) / multiply_add(at, turn, rate);
    return select(abs(better - at) < at * R(0.5), better, at);
  }
};

/// When a straight way comes to a sphere for the next time, s > 0, or `never`. It starts `outside`
/// (the square of its distance to the middle less that of the radius), `speed2` is the square of
/// its speed, and `ahead` the middle's place along it times the speed.
/// @param within  it counts as within the sphere, whatever rounding says close to it
template <class R>
[[nodiscard]] R until_sphere(typename R::Mask within, R ahead, R outside, R speed2) {
  const R square = ahead * ahead - outside * speed2;
  const R root = sqrt(max(square, R(0)));
  const R s = (ahead + select(within, root, -root)) / speed2;
  return select((square > R(0)) & (s > R(0)) & (speed2 > R(0)), s, R(never));
}
template <class R>
[[nodiscard]] R until_sphere(R ahead, R outside, R speed2) {
  return until_sphere(outside < R(0), ahead, outside, speed2);
}

/// The same for a way of speed 1 that bends, at right angles to its direction, by √`bend2`, and by
/// `inward` over the distance towards the middle.
template <class R>
[[nodiscard]] R until_sphere_on_curve(typename R::Mask within, R ahead, R outside, R inward,
                                      R bend2) {
  const R square = ahead * ahead - outside;
  const R root = square * inverse_sqrt(max(square, R(1e-30)));
  const R s = ahead + select(within, root, -root);
  // |at|² - R² = outside - 2 ahead s + (1 - inward) s² + bend2 s⁴/4, and one step of Newton's
  // method on it; all but what is written here is 0 at s.
  const R s2 = s * s, curl = bend2 * R(0.25) * s2;
  const R slope = multiply_add(s, curl + curl - inward, s - ahead);
  const R more = s2 * (inward - curl) * R(0.5) / slope;
  const auto trusted = abs(more) < abs(s) * R(0.5);
  return select((square > R(0)) & (s > R(0)), select(trusted, s + more, s), R(never));
}

}  // namespace portalens
