/// \file
/// Over lanes: how far it is along a path to a plane or a sphere.
#pragma once

#include "math/multiply_add.h"
#include "math/vec3.h"

namespace portalens {

/// A length that no way comes to.
inline constexpr float never = 1e30f;

/// When height `a` that changes at rate `v` reaches 0, or `never`.
template <class R>
[[nodiscard]] R until_zero(R a, R v) {
  const R s = -a / v;
  return select((s > R(0)) & (abs(v) > R(1e-12)), s, R(never));
}

/// Where a path comes to the first of some borders.
template <class R>
struct LaneBorder {
  R at{never};  ///< arc length
  /// Where the border is a plane, the height over it at the start of the path, and its normal; else
  /// a height of 1 over no plane.
  R height{1};
  Vec3<R> normal{R(0), R(0), R(0)};

  void offer(R its_at) { offer({its_at, R(1), {R(0), R(0), R(0)}}); }
  void offer(const LaneBorder& other) { take(other.at < at, other); }
  void take(typename R::Mask where, const LaneBorder& other) {
    at = select(where, other.at, at);
    height = select(where, other.height, height);
    normal = {select(where, other.normal.x, normal.x), select(where, other.normal.y, normal.y),
              select(where, other.normal.z, normal.z)};
  }
};

/// The plane that a path comes to first. It starts at some height over each, which changes at a
/// rate, and that at a rate of its own.
template <class R>
struct FirstPlane {
  LaneBorder<R> border;
  R rate{1}, turn{0};

  void offer(R height, R its_rate, R its_turn, Vec3<R> normal) {
    const R s = until_zero(height, its_rate);
    take(s < border.at, {{s, height, normal}, its_rate, its_turn});
  }
  void take(typename R::Mask where, const FirstPlane& other) {
    border.take(where, other.border);
    rate = select(where, other.rate, rate);
    turn = select(where, other.turn, turn);
  }
  /// By one step of Newton's method from the straight path.
  [[nodiscard]] LaneBorder<R> along_the_curve() const {
    const R at = border.at;
    const R better = at - at * at * turn * R(0.5) / multiply_add(at, turn, rate);
    return {select(abs(better - at) < at * R(0.5), better, at), border.height, border.normal};
  }
};

/// When a straight path comes to a sphere for the next time, s > 0, or `never`. It starts `outside`
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

/// The same for a path of speed 1 that bends, at right angles to its direction, by √`bend2`, and by
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

/// How far a straight path of speed 1 is from a ball about the origin: until it enters it, 0 within
/// it, `never` where it passes it.
template <class R>
[[nodiscard]] R until_ball(R radius, Vec3<R> from, Vec3<R> way) {
  const R ahead = -dot(from, way);
  // Also far off floats know the path's distance from the middle, but not the difference of
  // squares.
  const Vec3<R> aside = multiply_add(way, ahead, from);
  const R square = radius * radius - dot(aside, aside);
  const R s = ahead - sqrt(max(square, R(0)));
  const R comes = select((square > R(0)) & (ahead > R(0)), s, R(never));
  return select(dot(from, from) < radius * radius, R(0), max(comes, R(0)));
}

}  // namespace portalens
