/// \file
/// Over lanes: the nearest point of a portal's rectangle by the one-sided rule, and where what
/// decides it changes along a path.
#pragma once

#include "lanes/border.h"
#include "lanes/face_axes.h"
#include "lanes/first_meeting.h"
#include "lanes/path.h"
#include "math/multiply_add.h"
#include "math/vec3.h"

namespace portalens {

/// The feature of a rectangle that is nearest: q.x = keep_x · local.x + fix_x, and so on.
template <class R>
struct LaneNearest {
  R keep_x, fix_x, keep_y, fix_y;

  [[nodiscard]] R x(Vec3<R> local) const { return multiply_add(keep_x, local.x, fix_x); }
  [[nodiscard]] R y(Vec3<R> local) const { return multiply_add(keep_y, local.y, fix_y); }
  /// The nearest point, in the plane.
  [[nodiscard]] Vec3<R> place(Vec3<R> local) const { return {x(local), y(local), R(0)}; }
  [[nodiscard]] typename R::Mask same(const LaneNearest& other) const {
    return (keep_x == other.keep_x) & (fix_x == other.fix_x) & (keep_y == other.keep_y) &
           (fix_y == other.fix_y);
  }

  template <class Rectangle>
  [[nodiscard]] static LaneNearest on(const Rectangle& rectangle, Vec3<R> local) {
    return nearest_on(rectangle, local);
  }
  void take(typename R::Mask where, const LaneNearest& other) {
    keep_x = select(where, other.keep_x, keep_x);
    fix_x = select(where, other.fix_x, fix_x);
    keep_y = select(where, other.keep_y, keep_y);
    fix_y = select(where, other.fix_y, fix_y);
  }
  /// 1 where the nearest point moves as the photon does, be it along an edge only; else 0.
  [[nodiscard]] R moves() const { return max(keep_x, keep_y); }
  /// How fast the nearest point moves, as the photon does.
  [[nodiscard]] R speed_x(Vec3<R> way) const { return keep_x * way.x; }
  [[nodiscard]] R speed_y(Vec3<R> way) const { return keep_y * way.y; }
  /// How much its path sways, as the photon's does.
  [[nodiscard]] R sway_x(Vec3<R> sway) const { return keep_x * sway.x; }
  [[nodiscard]] R sway_y(Vec3<R> sway) const { return keep_y * sway.y; }
  /// Its path, as the photon's is; in the plane.
  [[nodiscard]] LocalPath<R> led_by(const LocalPath<R>& path) const {
    return {path.x * keep_x + fix_x, path.y * keep_y + fix_y, {}};
  }
};

/// What comes through a portal depends on where the nearest point of its rectangle is, not on where
/// the photon is: steps are the longer the slower that point moves. By how much less stiff and near
/// what comes counts.
/// @param speed_x, speed_y  of the point, per length of the path
template <class R>
[[nodiscard]] R slowness_of(R speed_x, R speed_y) {
  // A bent path soon moves what a straight one would leave in its place.
  const R least2(0.03);
  const R speed2 = multiply_add(speed_x, speed_x, multiply_add(speed_y, speed_y, least2));
  return speed2 * speed2;
}

/// From in front the nearest point of the rectangle, from behind that of its rim.
/// @param rectangle  has `half_width`, `half_height`, and `tolerance`: heights down to minus this
///                   count as in front
template <class R, class Rectangle>
[[nodiscard]] LaneNearest<R> nearest_on(const Rectangle& rectangle, Vec3<R> local) {
  const R w(rectangle.half_width), h(rectangle.half_height);
  const auto inside_x = abs(local.x) <= w, inside_y = abs(local.y) <= h;
  const R side_x = select(local.x < R(0), -w, w), side_y = select(local.y < R(0), -h, h);
  LaneNearest<R> nearest_point{select(inside_x, R(1), R(0)), select(inside_x, R(0), side_x),
                               select(inside_y, R(1), R(0)), select(inside_y, R(0), side_y)};
  const auto wraps = (local.z < R(-rectangle.tolerance)) & inside_x & inside_y;
  const auto to_side = w - abs(local.x) < h - abs(local.y);
  nearest_point.keep_x = select(wraps & to_side, R(0), nearest_point.keep_x);
  nearest_point.fix_x = select(wraps & to_side, side_x, nearest_point.fix_x);
  nearest_point.keep_y = select(wraps & !to_side, R(0), nearest_point.keep_y);
  nearest_point.fix_y = select(wraps & !to_side, side_y, nearest_point.fix_y);
  return nearest_point;
}

/// Where a place lies right behind a rectangle, so that its rim is nearest.
template <class R, class Rectangle>
[[nodiscard]] typename R::Mask is_behind(const Rectangle& rectangle, const LaneNearest<R>&,
                                         Vec3<R> local) {
  return (abs(local.x) <= R(rectangle.half_width)) & (abs(local.y) <= R(rectangle.half_height)) &
         (local.z < R(-rectangle.tolerance));
}

/// Where another feature than that of `nearest_point` is nearest.
template <class R, class Rectangle>
[[nodiscard]] typename R::Mask has_other_nearest(const Rectangle& rectangle,
                                                 const LaneNearest<R>& nearest_point,
                                                 Vec3<R> local) {
  const auto inside_x = abs(local.x) <= R(rectangle.half_width);
  const auto inside_y = abs(local.y) <= R(rectangle.half_height);
  const auto other_x = (inside_x & (nearest_point.keep_x == R(0))) |
                       ((!inside_x) & (nearest_point.fix_x * local.x <= R(0)));
  const auto other_y = (inside_y & (nearest_point.keep_y == R(0))) |
                       ((!inside_y) & (nearest_point.fix_y * local.y <= R(0)));
  const auto other = other_x | other_y;
  const auto wraps = inside_x & inside_y & (local.z < R(-rectangle.tolerance));
  if (!any(wraps)) return other;
  return (wraps & !nearest_point.same(nearest_on(rectangle, local))) | ((!wraps) & other);
}

/// True only where the feature of `nearest_point` stays the nearest along a path.
/// @param start, end  of the path
/// @param sway        of each coordinate, as of `keeps_margin`
template <class R, class Rectangle>
[[nodiscard]] typename R::Mask keeps_nearest(const Rectangle& rectangle,
                                             const LaneNearest<R>& nearest_point, Vec3<R> start,
                                             Vec3<R> end, Vec3<R> sway) {
  const R w(rectangle.half_width), h(rectangle.half_height), tolerance(rectangle.tolerance);
  const R across = select(start.x < R(0), -end.x, end.x);
  const R along = select(start.y < R(0), -end.y, end.y);
  const auto inside_x = abs(start.x) <= w, inside_y = abs(start.y) <= h;
  auto keeps =
      keeps_margin(abs(abs(start.x) - w), select(inside_x, w - abs(end.x), across - w), sway.x) &
      keeps_margin(abs(abs(start.y) - h), select(inside_y, h - abs(end.y), along - h), sway.y);
  const auto column = inside_x & inside_y;
  if (!any(column)) return keeps;
  const R z0 = start.z + tolerance, z1 = end.z + tolerance;
  const auto behind = column & (z0 < R(0));
  keeps = keeps & ((!column) | keeps_margin(abs(z0), select(behind, -z1, z1), sway.z));
  if (!any(behind)) return keeps;
  // There the feature is an edge: which one changes at the middle planes and the bisectors.
  const auto to_side = nearest_point.keep_x == R(0);
  const R gap = select(to_side, h - w, w - h);
  const auto margin = [&](R towards, Vec3<R> at) {
    return min(towards, towards + gap - abs(select(to_side, at.y, at.x)));
  };
  const R first = margin(select(to_side, abs(start.x), abs(start.y)), start);
  const R last = margin(select(to_side, across, along), end);
  return keeps & ((!behind) | keeps_margin(first, last, sway.x + sway.y));
}

/// Where the nearest feature of a rectangle changes within a span, at whose end it has.
template <class R, class Rectangle>
[[gnu::noinline]] void offer_borders(FirstMeeting<R>& first, const Rectangle& rectangle,
                                     const LaneNearest<R>& nearest_point, typename R::Mask may,
                                     const LocalPath<R>& path, LaneSpan<R> span) {
  const R w(rectangle.half_width), h(rectangle.half_height);
  const R x = path.x.at(span.high), y = path.y.at(span.high);
  const R side_x =
      select(nearest_point.keep_x > R(0), select(x < R(0), -w, w), nearest_point.fix_x);
  const R side_y =
      select(nearest_point.keep_y > R(0), select(y < R(0), -h, h), nearest_point.fix_y);
  auto met = first.offer(may, path.x + -side_x, span) | first.offer(may, path.y + -side_y, span);
  met = met | first.offer(may, path.z, span);
  const auto behind = may & (path.z.at(span.low) < R(0));
  if (any(behind)) {
    const R gap = h - w;
    met = met | first.offer(behind, path.x, span) | first.offer(behind, path.y, span) |
          first.offer(behind, path.x - path.y + gap, span) |
          first.offer(behind, path.x - path.y + -gap, span) |
          first.offer(behind, path.x + path.y + gap, span) |
          first.offer(behind, path.x + path.y + -gap, span);
  }
  first.miss(may & !met, span);
}

/// Where, straight on but for how the path turns at first, the nearest feature changes or the
/// distance to it passes the reach.
/// @param rectangle  has besides `reach2`
/// @param features   whether it matters which is nearest
/// @param way        direction, in local coordinates like `local`
/// @param turn       its rate of change, in the same
template <class R, class Rectangle>
[[nodiscard]] LaneBorder<R> until_other_nearest(const Rectangle& rectangle,
                                                const LaneNearest<R>& nearest_point,
                                                typename R::Mask features, Vec3<R> local,
                                                Vec3<R> way, Vec3<R> turn) {
  const R w(rectangle.half_width), h(rectangle.half_height);
  const Vec3<R> x{R(1), R(0), R(0)}, y{R(0), R(1), R(0)}, z{R(0), R(0), R(1)};
  FirstPlane<R> first;
  // Beside the rectangle its own plane divides nothing.
  const auto inside_x = abs(local.x) <= w, inside_y = abs(local.y) <= h;
  const auto column = inside_x & inside_y;
  first.offer(select(column, local.z, R(0)), way.z, turn.z, z);
  // From inside the path leads to one of two lines, from outside to the nearer first.
  const R side_x = select(select(inside_x, way.x, local.x) < R(0), -w, w);
  const R side_y = select(select(inside_y, way.y, local.y) < R(0), -h, h);
  first.offer(local.x - side_x, way.x, turn.x, x);
  first.offer(local.y - side_y, way.y, turn.y, y);
  // Behind the rectangle, the nearest edge changes: at the middle planes and the bisectors.
  const auto behind = column & (local.z < R(0));
  if (any(behind)) {
    const R gap = h - w;
    FirstPlane<R> medial = first;
    medial.offer(local.x, way.x, turn.x, x);
    medial.offer(local.y, way.y, turn.y, y);
    medial.offer(local.x - local.y + gap, way.x - way.y, turn.x - turn.y, x - y);
    medial.offer(local.x - local.y - gap, way.x - way.y, turn.x - turn.y, x - y);
    medial.offer(local.x + local.y + gap, way.x + way.y, turn.x + turn.y, x + y);
    medial.offer(local.x + local.y - gap, way.x + way.y, turn.x + turn.y, x + y);
    first.take(behind, medial);
  }
  const Vec3<R> from = local - nearest_point.place(local);
  const Vec3<R> rate{way.x * (R(1) - nearest_point.keep_x), way.y * (R(1) - nearest_point.keep_y),
                     way.z};
  const R outside = dot(from, from) - R(rectangle.reach2);
  LaneBorder<R> border = first.along_the_curve();
  border.at = select(features, border.at, R(never));
  border.offer(until_sphere(-dot(from, rate), outside, dot(rate, rate)));
  return border;
}

}  // namespace portalens
