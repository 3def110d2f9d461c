/// \file
/// Over lanes: the nearest point of a portal's rectangle by the one-sided rule, and where what
/// decides it changes along a way.
#pragma once

#include "math/vec3.h"
#include "photon/lane_border.h"
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

/// What comes through a portal depends on where the nearest point of its rectangle is, not on where
/// the photon is: steps are the longer the slower that point moves. By how much less stiff and near
/// what comes counts.
/// @param speed_x, speed_y  of the point, per length of the way
template <class R>
[[nodiscard]] R slowness_of(R speed_x, R speed_y) {
  // A bent way soon moves what a straight one would leave in its place.
  const R least2(0.03);
  const R speed2 = speed_x * speed_x + speed_y * speed_y + least2;
  return speed2 * speed2;
}

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

/// Where, straight on but for how the way turns at first, the nearest feature changes or the
/// distance to it passes the reach.
/// @param rectangle  has besides `reach2`
/// @param way        direction, in local coordinates like `local`
/// @param turn       its rate of change, in the same
template <class R, class Rectangle>
[[nodiscard]] R until_other_foot(const Rectangle& rectangle, const LaneFoot<R>& foot, Vec3<R> local,
                                 Vec3<R> way, Vec3<R> turn) {
  const R w(rectangle.half_width), h(rectangle.half_height);
  FirstPlane<R> first;
  // Beside the rectangle its own plane divides nothing.
  const auto column = (abs(local.x) <= w) & (abs(local.y) <= h);
  first.offer(select(column, local.z, R(0)), way.z, turn.z);
  first.offer(local.x - w, way.x, turn.x);
  first.offer(local.x + w, way.x, turn.x);
  first.offer(local.y - h, way.y, turn.y);
  first.offer(local.y + h, way.y, turn.y);
  // Behind the rectangle, the nearest edge changes: at the middle planes and the bisectors.
  const auto behind = column & (local.z < R(0));
  if (any(behind)) {
    const R gap = h - w;
    FirstPlane<R> medial = first;
    medial.offer(local.x, way.x, turn.x);
    medial.offer(local.y, way.y, turn.y);
    medial.offer(local.x - local.y + gap, way.x - way.y, turn.x - turn.y);
    medial.offer(local.x - local.y - gap, way.x - way.y, turn.x - turn.y);
    medial.offer(local.x + local.y + gap, way.x + way.y, turn.x + turn.y);
    medial.offer(local.x + local.y - gap, way.x + way.y, turn.x + turn.y);
    first.take(behind, medial);
  }
  const Vec3<R> from{local.x - foot.x(local), local.y - foot.y(local), local.z};
  const Vec3<R> rate{way.x * (R(1) - foot.keep_x), way.y * (R(1) - foot.keep_y), way.z};
  const R outside = dot(from, from) - R(rectangle.reach2);
  return min(first.along_the_curve(), until_sphere(-dot(from, rate), outside, dot(rate, rate)));
}

}  // namespace portalens
