/// \file
/// Over lanes: the nearest point of a portal that is a circle, by the one-sided rule, and where
/// what decides it changes along a path. `rectangle.h` for all shapes. On the rim it is
///     q = r p/|p|      p: the place in the plane, seen from the middle
/// which turns round as the place does.
#pragma once

#include "lanes/border.h"
#include "lanes/face_axes.h"
#include "lanes/first_meeting.h"

namespace portalens {

/// The feature of a circle that is nearest: its inside, or its rim.
template <class R>
struct LaneRoundNearest {
  using Mask = typename R::Mask;

  R over;              ///< 1: the inside, seen from in front; 0: the rim
  R radius;            ///< of the circle
  R along_x, along_y;  ///< from the middle to the place that it was found for, a unit vector
  R slow;              ///< how fast the point of the rim goes round, as that place does

  /// @param gate  has `half_width`, the radius, and `tolerance`
  template <class Gate>
  [[nodiscard]] static LaneRoundNearest on(const Gate& gate, Vec3<R> local) {
    const R radius(gate.half_width), square = square_of(local), inverse = inverse_length(square);
    const Mask inside = square <= radius * radius;
    return {select(inside & !(local.z < R(-gate.tolerance)), R(1), R(0)), radius, local.x * inverse,
            local.y * inverse, radius * inverse};
  }
  [[nodiscard]] static R square_of(Vec3<R> local) {
    return multiply_add(local.x, local.x, local.y * local.y);
  }

  [[nodiscard]] R x(Vec3<R> local) const { return local.x * share(local); }
  [[nodiscard]] R y(Vec3<R> local) const { return local.y * share(local); }
  /// It moves no faster than that, as the place does, while that comes no nearer to the middle than
  /// half as near as where this was found.
  [[nodiscard]] R fastest() const { return max(R(2) * slow, R(1)); }
  [[nodiscard]] R moves() const { return select(over > R(0), R(2), slow); }
  [[nodiscard]] R speed_x(Vec3<R> way) const {
    return select(over > R(0), way.x, -along_y * round(way));
  }
  [[nodiscard]] R speed_y(Vec3<R> way) const {
    return select(over > R(0), way.y, along_x * round(way));
  }
  /// The middle's height over the line through the place that is at right angles to its direction:
  /// what is above 0 lies on this side of the middle.
  [[nodiscard]] R ahead(Vec3<R> local) const {
    return multiply_add(along_x, local.x, along_y * local.y);
  }
  void take(Mask where, const LaneRoundNearest& other) {
    over = select(where, other.over, over);
    along_x = select(where, other.along_x, along_x);
    along_y = select(where, other.along_y, along_y);
    slow = select(where, other.slow, slow);
  }

 private:
  /// Finite in the middle, too.
  [[nodiscard]] static R inverse_length(R square) { return inverse_sqrt(max(square, R(1e-30))); }
  [[nodiscard]] R share(Vec3<R> local) const {
    return select(over > R(0), R(1), radius * inverse_length(square_of(local)));
  }
  [[nodiscard]] R round(Vec3<R> way) const {
    return slow * subtract_product(along_x * way.y, along_y, way.x);
  }
};

/// Where a place lies right behind a circle, so that its rim is nearest.
template <class R, class Gate>
[[nodiscard]] typename R::Mask is_behind(const Gate& gate, const LaneRoundNearest<R>& nearest_point,
                                         Vec3<R> local) {
  return (LaneRoundNearest<R>::square_of(local) <= nearest_point.radius * nearest_point.radius) &
         (local.z < R(-gate.tolerance));
}

/// Where the nearest point of the rim runs round so fast that lanes leave it to the scalar engine:
/// right behind the middle.
template <class R, class Gate>
[[nodiscard]] typename R::Mask runs_round(const Gate& gate,
                                          const LaneRoundNearest<R>& nearest_point, Vec3<R> local) {
  const R near = nearest_point.radius * R(0.1);
  return (LaneRoundNearest<R>::square_of(local) <= near * near) & (local.z < R(-gate.tolerance));
}

/// Where the other feature is nearest, or the middle has been passed.
template <class R, class Gate>
[[nodiscard]] typename R::Mask has_other_nearest(const Gate& gate,
                                                 const LaneRoundNearest<R>& nearest_point,
                                                 Vec3<R> local) {
  const auto now = LaneRoundNearest<R>::on(gate, local).over > R(0);
  const auto then = nearest_point.over > R(0);
  return (now ^ then) | ((!then) & (nearest_point.ahead(local) <= R(0)));
}

/// True only where the feature of `nearest_point` stays the nearest along a path.
/// @param start, end  of the path
/// @param sway        of each coordinate, as of `keeps_margin`
template <class R, class Gate>
[[nodiscard]] typename R::Mask keeps_nearest(const Gate& gate,
                                             const LaneRoundNearest<R>& nearest_point,
                                             Vec3<R> start, Vec3<R> end, Vec3<R> sway) {
  const R radius = nearest_point.radius, aside = sway.x + sway.y;
  const R from = sqrt(LaneRoundNearest<R>::square_of(start));
  const R to = sqrt(LaneRoundNearest<R>::square_of(end));
  const R z0 = start.z + R(gate.tolerance), z1 = end.z + R(gate.tolerance);
  const auto over = nearest_point.over > R(0);
  const auto stays_over =
      keeps_margin(radius - from, radius - to, aside) & keeps_margin(z0, z1, sway.z);
  if (!any(!over)) return stays_over;
  // From outside the circle lies behind a line that touches it.
  const R ahead0 = nearest_point.ahead(start), ahead1 = nearest_point.ahead(end);
  const auto stays_out = (from > radius) & keeps_margin(ahead0 - radius, ahead1 - radius, aside);
  const R least = radius * R(0.05);
  const auto stays_behind = (z0 < R(0)) & keeps_margin(-z0, -z1, sway.z) & (ahead0 > least) &
                            keeps_margin(ahead0 - least, ahead1 - least, aside);
  return (over & stays_over) | ((!over) & (stays_out | stays_behind));
}

/// Where the nearest feature changes within a span, at whose end it has.
template <class R, class Gate>
[[gnu::noinline]] void offer_borders(FirstMeeting<R>& first, const Gate&,
                                     const LaneRoundNearest<R>& nearest_point, typename R::Mask may,
                                     const LocalPath<R>& path, LaneSpan<R> span) {
  const LaneSquare<R> rim{path.x, path.y, {}, nearest_point.radius * nearest_point.radius};
  auto met = first.offer(may, rim, span) | first.offer(may, path.z, span);
  met = met | first.offer(may & !(nearest_point.over > R(0)),
                          path.x * nearest_point.along_x + path.y * nearest_point.along_y, span);
  first.miss(may & !met, span);
}

/// How far a straight path is surely out of a circle's reach: each time as far on as that is away.
/// What is right behind it is nearer at once when it has passed the plane.
template <class R, class Gate>
[[nodiscard]] R until_near(const Gate& gate, R radius, Vec3<R> local, Vec3<R> way) {
  constexpr int looks = 8;
  R along(0);
  for (int k = 0; k < looks; ++k) {
    const Vec3<R> at = multiply_add(way, along, local);
    const R aside = sqrt(LaneRoundNearest<R>::square_of(at)) - radius;
    const R to_rim = sqrt(multiply_add(aside, aside, at.z * at.z)) - R(gate.reach);
    const auto inside = aside <= R(0), behind = at.z < R(-gate.tolerance);
    const R over = select(behind, min(to_rim, -at.z), at.z - R(gate.reach));
    along = along + max(select(inside, over, to_rim), R(0));
  }
  return along;
}

/// Where, straight on but for how the path turns at first, the nearest feature changes or the
/// distance to it passes the reach.
/// @param gate      has besides `reach2`
/// @param features  whether it matters which is nearest
/// @param way       direction, in local coordinates like `local`
/// @param turn      its rate of change, in the same
template <class R, class Gate>
[[nodiscard]] LaneBorder<R> until_other_nearest(const Gate& gate,
                                                const LaneRoundNearest<R>& nearest_point,
                                                typename R::Mask features, Vec3<R> local,
                                                Vec3<R> way, Vec3<R> turn) {
  const R radius = nearest_point.radius, square = LaneRoundNearest<R>::square_of(local);
  const auto inside = square <= radius * radius;
  FirstPlane<R> first;
  // Beside the circle its own plane divides nothing; behind it the rim does not.
  first.offer(select(inside, local.z, R(0)), way.z, turn.z, {R(0), R(0), R(1)});
  LaneBorder<R> border = first.along_the_curve();
  const R to_rim = until_sphere(inside, -multiply_add(local.x, way.x, local.y * way.y),
                                square - radius * radius, LaneRoundNearest<R>::square_of(way));
  border.offer(select(local.z < R(-gate.tolerance), R(never), to_rim));
  border.at = select(features, border.at, R(never));
  const Vec3<R> from{local.x - nearest_point.x(local), local.y - nearest_point.y(local), local.z};
  const Vec3<R> rate{way.x - nearest_point.speed_x(way), way.y - nearest_point.speed_y(way), way.z};
  const R apart2 = dot(from, from), outside = apart2 - R(gate.reach2);
  const auto reached = outside < R(0);
  border.offer(select(reached, until_sphere(-dot(from, rate), outside, dot(rate, rate)),
                      until_near(gate, radius, local, way)));
  return border;
}

/// How far a mass, as seen through a circle, is from the nearest point of that, squared, less the
/// square of its influence.
template <class R>
struct LaneRoundFading {
  const LaneRoundNearest<R>& nearest_point;
  LocalPath<R> path;
  Vec3<R> image;
  R influence2;

  [[nodiscard]] R at(R u) const {
    const Vec3<R> d = apart(local(u));
    return dot(d, d) - influence2;
  }
  [[nodiscard]] R slope(R u) const {
    const Vec3<R> here = local(u), way{path.x.slope(u), path.y.slope(u), R(0)};
    LaneRoundNearest<R> found = nearest_point;
    const R inverse = inverse_sqrt(max(LaneRoundNearest<R>::square_of(here), R(1e-30)));
    found.along_x = here.x * inverse;
    found.along_y = here.y * inverse;
    found.slow = found.radius * inverse;
    return R(2) * dot(apart(here), Vec3<R>{found.speed_x(way), found.speed_y(way), R(0)});
  }

 private:
  [[nodiscard]] Vec3<R> local(R u) const { return {path.x.at(u), path.y.at(u), path.z.at(u)}; }
  [[nodiscard]] Vec3<R> apart(Vec3<R> here) const {
    return Vec3<R>{nearest_point.x(here), nearest_point.y(here), R(0)} - image;
  }
};

}  // namespace portalens
