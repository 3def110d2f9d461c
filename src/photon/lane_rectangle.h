/// \file
/// Over lanes: the nearest point of a portal's rectangle by the one-sided rule, and where what
/// decides it changes along a way.
#pragma once

#include "math/vec3.h"
#include "photon/lane_scene.h"

namespace portalens {

template <class R>
Vec3<R> spread(LaneVec v) {
  return {R(v.x), R(v.y), R(v.z)};
}

/// In local coordinates of a frame.
template <class R>
Vec3<R> to_axes(Vec3<R> d, LaneVec right, LaneVec up, LaneVec normal) {
  return {dot(d, spread<R>(right)), dot(d, spread<R>(up)), dot(d, spread<R>(normal))};
}

/// A place in the local coordinates of a face.
template <class R>
Vec3<R> local_in(const LaneFace& face, Vec3<R> x) {
  return to_axes(x - spread<R>(face.origin), face.right, face.up, face.normal);
}

/// The feature of a rectangle that is nearest: q.x = keep_x · local.x + fix_x, and so on.
template <class R>
struct LaneFoot {
  R keep_x, fix_x, keep_y, fix_y;

  [[nodiscard]] R x(Vec3<R> local) const { return keep_x * local.x + fix_x; }
  [[nodiscard]] R y(Vec3<R> local) const { return keep_y * local.y + fix_y; }
};

/// From in front the nearest point of the rectangle, from behind that of its rim.
/// @param rectangle  has `half_width`, `half_height`, and `tolerance`: heights down to minus this
///                   count as in front
template <class R, class Rectangle>
[[nodiscard]] LaneFoot<R> foot_on(const Rectangle& rectangle, Vec3<R> local) {
  const R w(rectangle.half_width), h(rectangle.half_height);
  const auto inside_x = abs(local.x) <= w, inside_y = abs(local.y) <= h;
  const R side_x = select(local.x < R(0), -w, w), side_y = select(local.y < R(0), -h, h);
  LaneFoot<R> foot{select(inside_x, R(1), R(0)), select(inside_x, R(0), side_x),
                   select(inside_y, R(1), R(0)), select(inside_y, R(0), side_y)};
  const auto wraps = (local.z < R(-rectangle.tolerance)) & inside_x & inside_y;
  const auto to_side = w - abs(local.x) < h - abs(local.y);
  foot.keep_x = select(wraps & to_side, R(0), foot.keep_x);
  foot.fix_x = select(wraps & to_side, side_x, foot.fix_x);
  foot.keep_y = select(wraps & !to_side, R(0), foot.keep_y);
  foot.fix_y = select(wraps & !to_side, side_y, foot.fix_y);
  return foot;
}

/// When height `a` that changes at rate `v` reaches 0, or `never`.
template <class R>
[[nodiscard]] R until_zero(R a, R v, R never) {
  const R s = -a / v;
  return select((s > R(0)) & (abs(v) > R(1e-12)), s, never);
}

/// Where |from + t s + bend s²/2|² = radius2 for the next time, s > 0, or `never`.
template <class R>
[[nodiscard]] R until_shell(Vec3<R> from, Vec3<R> t, Vec3<R> bend, R radius2, R never) {
  const R speed2 = dot(t, t), along = dot(from, t), outside = dot(from, from) - radius2;
  const R square = along * along - outside * speed2;
  const R root = sqrt(max(square, R(0)));
  // The stable one of the two forms of each solution.
  const R inward = select(along > R(0), -outside / (along + root), (root - along) / speed2);
  R s = select(outside < R(0), inward, (-along - root) / speed2);
  const Vec3<R> at = from + t * s + bend * (s * s * R(0.5));
  const R slope = R(2) * dot(at, t + bend * s);
  const R better = s - (dot(at, at) - radius2) / slope;
  s = select((abs(better - s) < abs(s) * R(0.5)) & (better > R(0)), better, s);
  return select((square > R(0)) & (s > R(0)) & (speed2 > R(0)), s, never);
}

/// Where, straight on, the nearest feature changes or the distance to it passes the reach.
/// @param rectangle  has besides `reach2`
/// @param way        direction, in local coordinates like `local`
template <class R, class Rectangle>
[[nodiscard]] R until_other_foot(const Rectangle& rectangle, const LaneFoot<R>& foot, Vec3<R> local,
                                 Vec3<R> way, R never) {
  const R w(rectangle.half_width), h(rectangle.half_height);
  const auto until = [&](R a, R v) { return until_zero(a, v, never); };
  R least = until(local.z, way.z);
  least = min(least, until(local.x - w, way.x));
  least = min(least, until(local.x + w, way.x));
  least = min(least, until(local.y - h, way.y));
  least = min(least, until(local.y + h, way.y));
  // Behind the rectangle, the nearest edge changes: at the middle planes and the bisectors.
  const R gap = h - w;
  R medial = min(until(local.x, way.x), until(local.y, way.y));
  medial = min(medial, until(local.x - local.y + gap, way.x - way.y));
  medial = min(medial, until(local.x - local.y - gap, way.x - way.y));
  medial = min(medial, until(local.x + local.y + gap, way.x + way.y));
  medial = min(medial, until(local.x + local.y - gap, way.x + way.y));
  const auto behind = (local.z < R(0)) & (abs(local.x) < w) & (abs(local.y) < h);
  least = select(behind, min(least, medial), least);
  const Vec3<R> from{local.x - foot.x(local), local.y - foot.y(local), local.z};
  const Vec3<R> rate{way.x * (R(1) - foot.keep_x), way.y * (R(1) - foot.keep_y), way.z};
  return min(least, until_shell(from, rate, {R(0), R(0), R(0)}, R(rectangle.reach2), never));
}

}  // namespace portalens
