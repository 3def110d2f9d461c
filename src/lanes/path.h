/// \file
/// Over lanes: the path of one step, and where it meets planes and balls.
#pragma once

#include "math/multiply_add.h"
#include "math/vec3.h"
#include "photon/radau.h"

namespace portalens {

/// Bounds the length of a vector from above, to within a factor of √3.
template <class R>
R span(Vec3<R> v) {
  return abs(v.x) + abs(v.y) + abs(v.z);
}

/// A vector whose length is nearly 1, made 1: by one step of Newton's method, or where it is off by
/// more than that mends, exactly.
template <class R>
Vec3<R> unit(Vec3<R> v) {
  const R square = dot(v, v);
  R scale = subtract_product(R(1.5), R(0.5), square);
  const auto off = abs(square - R(1)) > R(1e-3);
  if (any(off)) scale = select(off, R(1) / sqrt(square), scale);
  return v * scale;
}

template <class R>
Vec3<R> choose(typename R::Mask which, Vec3<R> a, Vec3<R> b) {
  return {select(which, a.x, b.x), select(which, a.y, b.y), select(which, a.z, b.z)};
}

/// What one lane holds, in all.
template <class R>
R of_lane(R values, int lane) {
  alignas(64) float all[R::lanes];
  values.store(all);
  return R(all[lane]);
}
template <class R>
Vec3<R> of_lane(Vec3<R> v, int lane) {
  return {of_lane(v.x, lane), of_lane(v.y, lane), of_lane(v.z, lane)};
}

/// A polynomial in the share u of a step, 0 to 1.
template <class R, class T>
struct LaneQuintic {
  T c0, c1, c2, c3, c4, c5;

  [[nodiscard]] T at(R u) const {
    const T end = multiply_add(multiply_add(multiply_add(c5, u, c4), u, c3), u, c2);
    return multiply_add(multiply_add(end, u, c1), u, c0);
  }
  [[nodiscard]] T slope(R u) const {
    const T end = multiply_add(multiply_add(c5, R(5) * u, c4 * R(4)), u, c3 * R(3));
    return multiply_add(multiply_add(end, u, c2 * R(2)), u, c1);
  }

  friend LaneQuintic operator+(const LaneQuintic& a, const LaneQuintic& b) {
    return {a.c0 + b.c0, a.c1 + b.c1, a.c2 + b.c2, a.c3 + b.c3, a.c4 + b.c4, a.c5 + b.c5};
  }
  friend LaneQuintic operator-(const LaneQuintic& a, const LaneQuintic& b) {
    return {a.c0 - b.c0, a.c1 - b.c1, a.c2 - b.c2, a.c3 - b.c3, a.c4 - b.c4, a.c5 - b.c5};
  }
  friend LaneQuintic operator+(const LaneQuintic& a, T more) {
    return {a.c0 + more, a.c1, a.c2, a.c3, a.c4, a.c5};
  }
  friend LaneQuintic operator*(const LaneQuintic& a, R scale) {
    return {a.c0 * scale, a.c1 * scale, a.c2 * scale, a.c3 * scale, a.c4 * scale, a.c5 * scale};
  }
};

/// Where it vanishes, in the lanes of `which`: `at(u) * before` is positive at `low` and negative
/// at `high`, however flat it is between. Newton's method, kept within what is left, until it moves
/// so little that its next move is lost in rounding; a lane that has come to rest stays there,
/// whatever the others do.
template <class R, class Function>
[[nodiscard]] R crossing(typename R::Mask which, const Function& function, R guess, R before, R low,
                         R high) {
  R u = guess;
  for (int i = 0; i < 6; ++i) {
    const R at = function.at(u);
    const auto early = at * before > R(0);
    low = select(early, u, low);
    high = select(early, high, u);
    const R newton = u - at / function.slope(u);
    const auto within = (newton >= low) & (newton <= high);
    const R better = select(within, newton, (low + high) * R(0.5));
    const auto moved_far = which & !(abs(better - u) <= R(1e-3));
    u = select(which, better, u);
    which = moved_far;
    if (!any(which)) break;
  }
  return u;
}

/// A part of a step, lane by lane, as shares of it.
template <class R>
struct LaneSpan {
  R low, high;
};

/// The step's path.
template <class R>
struct LanePath {
  using V = Vec3<R>;
  LaneQuintic<R, V> place;
  StateOf<R> end;  ///< a little more exact than `place` is there
  R h;
  R turn;   ///< the most that it turns by
  R stray;  ///< how far the path can be from the straight path along its first direction
  /// How far it can be from its chord, divided by u (1 - u). Between the nodes bends may be a
  /// little stronger than there.
  R sway;
  R met{1};  ///< the share at which it meets something: what is past that does not matter

  LanePath(const StateOf<R>& start, const Bends<R>& bends, R length)
      : end(Radau::end(start, bends, length)), h(length) {
    using radau_details::polynomial;
    end.direction = unit(end.direction);
    const R h2 = h * h;
    place.c0 = start.position;
    place.c1 = start.direction * h;
    place.c2 = bends.at[0] * (h2 * R(1.0 / 2.0));
    place.c3 = bends.sum(polynomial[1]) * (h2 * R(1.0 / 6.0));
    place.c4 = bends.sum(polynomial[2]) * (h2 * R(1.0 / 12.0));
    place.c5 = bends.sum(polynomial[3]) * (h2 * R(1.0 / 20.0));
    turn = Radau::turn(bends, h);
    // At no share of the step do the bends count for more together than one that lasts.
    stray = R(0.5001) * h * turn;
    sway = R(1.25) * stray;
  }

  /// Goes on, in some lanes, to a share of itself, which may be a little more than 1.
  void stretch(typename R::Mask where, R to) {
    const R share = select(where, to, R(1)), share2 = share * share;
    place.c1 = place.c1 * share;
    place.c2 = place.c2 * share2;
    place.c3 = place.c3 * (share2 * share);
    place.c4 = place.c4 * (share2 * share2);
    place.c5 = place.c5 * (share2 * share2 * share);
    const R more = max(share, R(1));
    h = h * share;
    turn = turn * more;
    stray = stray * (more * more);
    sway = sway * (more * more);
    const V last = place.at(R(1)), way = unit(place.slope(R(1)) * (R(1) / h));
    end = {choose(where, last, end.position), choose(where, way, end.direction)};
  }

  /// The path of one lane, in all.
  [[nodiscard]] LanePath of(int lane) const {
    LanePath one(*this);
    for (V* c :
         {&one.place.c0, &one.place.c1, &one.place.c2, &one.place.c3, &one.place.c4, &one.place.c5})
      *c = of_lane(*c, lane);
    for (V* v : {&one.end.position, &one.end.direction}) *v = of_lane(*v, lane);
    for (R* value : {&one.h, &one.turn, &one.stray, &one.sway, &one.met})
      *value = of_lane(*value, lane);
    return one;
  }

  /// The height over a plane, from that of the start.
  [[nodiscard]] LaneQuintic<R, R> height(R start, V normal) const {
    return {start,
            dot(place.c1, normal),
            dot(place.c2, normal),
            dot(place.c3, normal),
            dot(place.c4, normal),
            dot(place.c5, normal)};
  }

  /// False only where it stays out of a ball about `-from`, as seen from its start.
  [[nodiscard]] typename R::Mask may_touch(V from, R radius) const {
    const R along = -dot(from, place.c1);
    const R length2 = dot(place.c1, place.c1);
    const R share = min(max(along, R(0)), length2) / length2;
    const V nearest = multiply_add(place.c1, share, from);
    const R within = (radius + stray) * R(1.0001);
    return dot(nearest, nearest) <= within * within;
  }
};

/// Up to which share of a step lanes look whether what acts has changed: nearly to what it meets,
/// or to its end.
/// @param over  how far past a border a step ends
template <class R>
[[nodiscard]] R last_look(const LanePath<R>& path, R over) {
  return max(path.met - R(2) * over / path.h, path.met * R(0.5));
}

/// The places on a step's path at which they look, from the first, its start.
template <class R>
struct LaneLooks {
  static constexpr int count = 4;
  R share[count];
  Vec3<R> place[count];

  LaneLooks(const LanePath<R>& path, R over) {
    const R last = last_look(path, over);
    for (int k = 0; k < count; ++k) {
      share[k] = last * R(k / (count - 1.0));
      place[k] = path.place.at(share[k]);
    }
  }
  [[nodiscard]] LaneSpan<R> before(int k) const { return {share[k - 1], share[k]}; }
};

/// True only where a margin vanishes nowhere along a path: nowhere is
///     first (1 - u) + last u < sway · u (1 - u).
/// Along its chord the margin must be concave: the distance from the border of a convex region, or
/// from that of a ball to its inside.
/// @param first, last  at the ends of the path; the first is not negative
template <class R>
[[nodiscard]] typename R::Mask keeps_margin(R first, R last, R sway) {
  const R less = sway - first - last;
  return (last >= R(0)) & ((less <= R(0)) | (less * less <= R(4) * first * last));
}

/// True only where a path that begins further than that from something stays further.
/// @param first, last  from its nearest points, each to its end of the path
/// @param chord        from end to end of the path
/// @param convex       it is, as seen from both
template <class R>
[[nodiscard]] typename R::Mask stays_beyond(R radius, Vec3<R> first, Vec3<R> last, Vec3<R> chord,
                                            const LanePath<R>& path, typename R::Mask convex) {
  const R from = sqrt(dot(first, first)), to = sqrt(dot(last, last));
  // The distance falls nowhere where it grows at the start, or still falls at the end.
  return (to >= radius) & ((from + to >= radius + radius + path.h) |
                           (convex & ((dot(first, chord) >= path.sway * from) |
                                      (dot(last, chord) <= -path.sway * to))));
}

/// True only where a path stays within a ball, or out of it.
/// @param within  it counts as within at its start
/// @param first, last  from the ball's middle to the ends of the path
template <class R>
[[nodiscard]] typename R::Mask keeps_its_side(typename R::Mask within, Vec3<R> first, Vec3<R> last,
                                              R radius, const LanePath<R>& path) {
  const R from = sqrt(dot(first, first)), to = sqrt(dot(last, last));
  const auto stays_in = keeps_margin(radius - from, radius - to, path.sway);
  if (!any(!within)) return stays_in;
  return (within & stays_in) |
         ((!within) & stays_beyond(radius, first, last, last - first, path, R(0) < R(1)));
}

/// The square of a path's distance from a place, less that of a radius.
template <class R>
struct LaneDistance {
  const LanePath<R>& path;
  Vec3<R> center;
  R radius2;

  [[nodiscard]] R at(R u) const {
    const Vec3<R> d = path.place.at(u) - center;
    return dot(d, d) - radius2;
  }
  [[nodiscard]] R slope(R u) const {
    return R(2) * dot(path.place.at(u) - center, path.place.slope(u));
  }
  /// Where it vanishes as seen from `u`, where it is negative, if the path were straight there:
  /// before `u` with a side of -1, after it with 1. A path that grazes is met thus, too.
  [[nodiscard]] R surface_from(R u, R side) const {
    const R speed2 = dot(path.place.c1, path.place.c1), half_slope = slope(u) * R(0.5);
    const R root = sqrt(max(half_slope * half_slope - at(u) * speed2, R(0)));
    return min(max(u + (side * root - half_slope) / speed2, R(0)), R(1));
  }
  /// The share of the step where it is least, or nearly: two steps of Newton's method that take the
  /// path for straight near it.
  [[nodiscard]] R nearest() const {
    const R speed2 = dot(path.place.c1, path.place.c1);
    R u = -dot(path.place.c0 - center, path.place.c1) / speed2;
    u = min(max(u, R(0)), R(1));
    for (int i = 0; i < 2; ++i) {
      const R better = u - dot(path.place.at(u) - center, path.place.slope(u)) / speed2;
      u = min(max(better, R(0)), R(1));
    }
    return u;
  }
};

/// The square of the length of a vector along a step's path, less that of a radius.
template <class R>
struct LaneSquare {
  LaneQuintic<R, R> x, y, z;
  R radius2;

  [[nodiscard]] R at(R u) const {
    const Vec3<R> d{x.at(u), y.at(u), z.at(u)};
    return dot(d, d) - radius2;
  }
  [[nodiscard]] R slope(R u) const {
    return R(2) * (x.at(u) * x.slope(u) + y.at(u) * y.slope(u) + z.at(u) * z.slope(u));
  }
};

}  // namespace portalens
