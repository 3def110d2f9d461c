/// \file
/// Over lanes: the nearest point of a portal that is an ellipse (a circle is one), by the one-sided
/// rule, and where what decides it changes along a path. `rectangle.h` for all shapes. On the rim
/// it is (a cos θ, b sin θ), where Ellipse's D(θ) vanishes (portal/ellipse.h). It moves along the
/// rim's tangent as the place does, times ρ/(ρ + δ): ρ is the rim's radius of curvature, δ the
/// distance from it, below 0 inside.
#pragma once

#include "lanes/border.h"
#include "lanes/face_axes.h"
#include "lanes/first_meeting.h"

namespace portalens {

/// The feature of an ellipse that is nearest: its inside, or its rim. Behind it two places of the
/// rim are as near from a line in the middle, on the longer axis, so the rim's halves count as two.
template <class R>
struct LaneEllipseNearest {
  using Mask = typename R::Mask;

  float a, b;    ///< radii along x and y
  R over;        ///< 1: the inside, seen from in front; 0: the rim
  R half;        ///< 1 or -1: which half of the rim is nearest from behind
  R cos, sin;    ///< of the rim's place, for the place that this was found for
  R slow;        ///< how fast the rim's place moves as that place does along its tangent
  R unbranched;  ///< within this distance from that place no two places of the half are as near

  /// @param gate  has `outline`, an ellipse, and `tolerance`
  template <class Gate>
  [[nodiscard]] static LaneEllipseNearest on(const Gate& gate, Vec3<R> local) {
    LaneEllipseNearest found;
    found.a = gate.outline->radius_x;
    found.b = gate.outline->radius_y;
    const Mask before_plane = !(local.z < R(-gate.tolerance));
    found.over = select((found.square_of(local) <= R(1)) & before_plane, R(1), R(0));
    found.half = select(found.across(local) < R(0), R(-1), R(1));
    found.find_rim(local);
    return found;
  }
  /// The same feature's, for another place.
  [[nodiscard]] LaneEllipseNearest moved_to(Vec3<R> local) const {
    LaneEllipseNearest found = *this;
    found.find_rim(local);
    return found;
  }

  /// 1 on the rim, below it inside.
  [[nodiscard]] R square_of(Vec3<R> local) const {
    const R u = local.x * R(1.0f / a), v = local.y * R(1.0f / b);
    return multiply_add(u, u, v * v);
  }
  [[nodiscard]] R shorter() const { return R(a < b ? a : b); }
  /// Along the shorter axis.
  [[nodiscard]] R across(Vec3<R> local) const { return is_wide() ? local.y : local.x; }
  [[nodiscard]] Vec3<R> axis_across() const {
    return {R(is_wide() ? 0 : 1), R(is_wide() ? 1 : 0), R(0)};
  }
  /// At least how far a place is from the rim; below 0 inside.
  [[nodiscard]] R outside(Vec3<R> local) const {
    return (sqrt(square_of(local)) - R(1)) * shorter();
  }

  [[nodiscard]] Vec3<R> place(Vec3<R> local) const {
    const Vec3<R> inside{local.x, local.y, R(0)};
    if (!any(over <= R(0))) return inside;
    const Turn rim = rim_near(local);
    return choose(over > R(0), inside, {rim.cos * R(a), rim.sin * R(b), R(0)});
  }
  /// It moves no faster than that, as a place does that comes no further than `h` from where this
  /// was found.
  [[nodiscard]] R fastest(R h) const {
    const R left = max(unbranched - h, R(1e-3) * shorter());
    return R(1) + shorter() / left;
  }
  /// How fast the nearest point moves, as the photon does, at the most.
  [[nodiscard]] R moves() const { return select(over > R(0), R(1), slow); }
  /// 1 over the square of the distance to the rim's centre of curvature, where the nearest point
  /// would swing round at once.
  [[nodiscard]] R swings() const {
    const R per_radius = R(a * b) * slow / tangent2();
    return select(over > R(0), R(0), per_radius * per_radius / tangent2());
  }
  [[nodiscard]] R speed_x(Vec3<R> way) const {
    return select(over > R(0), way.x, -(R(a) * sin) * round(way));
  }
  [[nodiscard]] R speed_y(Vec3<R> way) const {
    return select(over > R(0), way.y, R(b) * cos * round(way));
  }
  /// How far a place lies beyond the line that touches the rim at its nearest place.
  [[nodiscard]] R beyond_tangent(Vec3<R> local) const {
    const R ahead = multiply_add(R(b) * cos, local.x, R(a) * sin * local.y) - R(a * b);
    return ahead * inverse_sqrt(tangent2());
  }
  void take(Mask where, const LaneEllipseNearest& other) {
    a = other.a;
    b = other.b;
    over = select(where, other.over, over);
    half = select(where, other.half, half);
    cos = select(where, other.cos, cos);
    sin = select(where, other.sin, sin);
    slow = select(where, other.slow, slow);
    unbranched = select(where, other.unbranched, unbranched);
  }

 private:
  struct Turn {
    R cos, sin;
  };

  [[nodiscard]] bool is_wide() const { return a >= b; }
  /// The square of d(a cos θ, b sin θ)/dθ.
  [[nodiscard]] R tangent2() const {
    const R x = R(a) * sin, y = R(b) * cos;
    return multiply_add(x, x, y * y);
  }
  /// How fast θ changes.
  [[nodiscard]] R round(Vec3<R> way) const {
    return slow * subtract_product(R(b) * cos * way.y, R(a) * sin, way.x) / tangent2();
  }

  void find_rim(Vec3<R> local) {
    const Turn rim = rim_near(local);
    cos = rim.cos;
    sin = rim.sin;
    const R square = tangent2(), apart((b - a) * (b + a));
    const R rises = multiply_add(
        R(b) * local.y, sin,
        multiply_add(R(a) * local.x, cos, apart * subtract_product(cos * cos, sin, sin)));
    slow = square / max(rises, R(1e-6) * square);
    const float longer = is_wide() ? a : b, less = is_wide() ? b : a;
    const R along = abs(is_wide() ? local.x : local.y), aside = across(local);
    const R beyond = max(along - R((longer - less) * (longer + less) / longer), R(0));
    unbranched = sqrt(multiply_add(beyond, beyond, aside * aside));
  }

  /// The rim's place that is nearest: by Newton's method on D, from a place that is right for a
  /// circle, near the rim and near the middle line. In the quadrant of the place D vanishes once;
  /// from inside, in the half of the rim that this feature is. What has been found stays, whoever
  /// is beside.
  [[nodiscard]] Turn rim_near(Vec3<R> local) const {
    const float longer = is_wide() ? a : b, less = is_wide() ? b : a;
    const R u = is_wide() ? local.x : local.y, v = across(local);
    const Mask inside = square_of(local) < R(1);
    const R side_u = select(u < R(0), R(-1), R(1));
    const R side_v = select(inside, half, select(v < R(0), R(-1), R(1)));
    const R along = u * side_u, aside = v * side_v;
    Turn t = scaled({select(inside, along * R(1.0f / longer), along * R(longer)),
                     select(inside, R(0), aside * R(less))});
    const R inner = min(along * R(1.0f / longer), R(1));
    t.cos = select(inside, inner, t.cos);
    t.sin = select(inside, sqrt(max(subtract_product(R(1), inner, inner), R(0))), t.sin);
    const R apart((longer - less) * (longer + less));
    const R by_u = along * R(longer), by_v = aside * R(less);
    Mask moves = R(0) < R(1);
    for (int k = 0; k < 13; ++k) {
      const R at = subtract_product(t.sin * multiply_add(-apart, t.cos, by_u), by_v, t.cos);
      const R rises = multiply_add(
          by_v, t.sin,
          multiply_add(by_u, t.cos, -apart * subtract_product(t.cos * t.cos, t.sin, t.sin)));
      const R by = select(rises > R(0), min(max(-at / rises, R(-1)), R(1)),
                          select(at > R(0), R(-0.5), R(0.5)));
      Turn next{max(subtract_product(t.cos, by, t.sin), R(0)), multiply_add(by, t.cos, t.sin)};
      // Past the middle line the half goes on.
      next.sin = select(aside < R(0), next.sin, max(next.sin, R(0)));
      next = scaled(next);
      t.cos = select(moves, next.cos, t.cos);
      t.sin = select(moves, next.sin, t.sin);
      moves = moves & (abs(by) > R(1e-4));
      if (!any(moves)) break;
    }
    // An inverse root is not exact to a float's last digits; what is nearly 1, this makes so.
    const R exact = subtract_product(R(1.5), R(0.5), multiply_add(t.cos, t.cos, t.sin * t.sin));
    const R cos_u = t.cos * side_u * exact, sin_v = t.sin * side_v * exact;
    return is_wide() ? Turn{cos_u, sin_v} : Turn{sin_v, cos_u};
  }
  [[nodiscard]] static Turn scaled(Turn t) {
    const R scale = inverse_sqrt(max(multiply_add(t.cos, t.cos, t.sin * t.sin), R(1e-30)));
    return {t.cos * scale, t.sin * scale};
  }
};

/// Where a place lies right behind an ellipse, so that its rim is nearest.
template <class R, class Gate>
[[nodiscard]] typename R::Mask is_behind(const Gate& gate, const LaneEllipseNearest<R>& found,
                                         Vec3<R> local) {
  return (found.square_of(local) <= R(1)) & (local.z < R(-gate.tolerance));
}

/// Where the place that `found` was found for makes the nearest point of the rim run so fast that
/// lanes leave it to the scalar engine: behind the middle line.
template <class R>
[[nodiscard]] typename R::Mask runs_round(const LaneEllipseNearest<R>& found) {
  return (found.over <= R(0)) & (found.slow > R(10));
}

/// Where the other feature is nearest, or the other half.
template <class R, class Gate>
[[nodiscard]] typename R::Mask has_other_nearest(const Gate& gate,
                                                 const LaneEllipseNearest<R>& found,
                                                 Vec3<R> local) {
  const auto inside = found.square_of(local) <= R(1);
  const auto now = inside & !(local.z < R(-gate.tolerance)), then = found.over > R(0);
  return (now ^ then) | (inside & !then & (found.across(local) * found.half < R(0)));
}

/// True only where the feature of `found` stays the nearest along a path.
/// @param start, end  of the path
/// @param sway        of each coordinate, as of `keeps_margin`
template <class R, class Gate>
[[nodiscard]] typename R::Mask keeps_nearest(const Gate& gate, const LaneEllipseNearest<R>& found,
                                             Vec3<R> start, Vec3<R> end, Vec3<R> sway) {
  const R aside = sway.x + sway.y;
  const R from = found.outside(start), to = found.outside(end);
  const R z0 = start.z + R(gate.tolerance), z1 = end.z + R(gate.tolerance);
  const auto over = found.over > R(0);
  const auto stays_over = keeps_margin(-from, -to, aside) & keeps_margin(z0, z1, sway.z);
  if (!any(!over)) return stays_over;
  // From outside the ellipse lies behind a line that touches it.
  const auto stays_out =
      (from > R(0)) & keeps_margin(found.beyond_tangent(start), found.beyond_tangent(end), aside);
  const auto stays_behind =
      (z0 < R(0)) & keeps_margin(-z0, -z1, sway.z) &
      keeps_margin(found.across(start) * found.half, found.across(end) * found.half, aside);
  return (over & stays_over) | ((!over) & (stays_out | stays_behind));
}

/// Where the nearest feature changes within a span, at whose end it has.
template <class R, class Gate>
[[gnu::noinline]] void offer_borders(FirstMeeting<R>& first, const Gate&,
                                     const LaneEllipseNearest<R>& found, typename R::Mask may,
                                     const LocalPath<R>& path, LaneSpan<R> span) {
  const LaneSquare<R> rim{path.x * R(1.0f / found.a), path.y * R(1.0f / found.b), {}, R(1)};
  const Vec3<R> axis = found.axis_across();
  const auto across = path.x * axis.x + path.y * axis.y;
  const auto met = first.offer(may, rim, span) | first.offer(may, path.z, span) |
                   first.offer(may & !(found.over > R(0)), across, span);
  first.miss(may & !met, span);
}

/// How far a straight path is surely out of an ellipse's reach: each time as far on as that is
/// away. What is right behind it is nearer at once when it has passed the plane.
template <class R, class Gate>
[[nodiscard]] R until_near(const Gate& gate, const LaneEllipseNearest<R>& found, Vec3<R> local,
                           Vec3<R> way) {
  constexpr int looks = 8;
  const R longer(found.a < found.b ? found.b : found.a);
  R along(0);
  for (int k = 0; k < looks; ++k) {
    const Vec3<R> at = multiply_add(way, along, local);
    const R within = found.outside(at);
    const R far = sqrt(multiply_add(at.x, at.x, at.y * at.y)) - longer;
    const auto inside = within <= R(0), behind = at.z < R(-gate.tolerance);
    const R aside = select(inside, within, max(within, far));
    const R to_rim = sqrt(multiply_add(aside, aside, at.z * at.z)) - R(gate.reach);
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
                                                const LaneEllipseNearest<R>& found,
                                                typename R::Mask features, Vec3<R> local,
                                                Vec3<R> way, Vec3<R> turn) {
  const R square = found.square_of(local);
  const auto inside = square <= R(1), behind = inside & (local.z < R(-gate.tolerance));
  FirstPlane<R> first;
  // Beside the ellipse its own plane divides nothing; behind it the rim does not.
  first.offer(select(inside, local.z, R(0)), way.z, turn.z, {R(0), R(0), R(1)});
  first.offer(select(behind, found.across(local), R(0)), found.across(way), found.across(turn),
              found.axis_across());
  LaneBorder<R> border = first.along_the_curve();
  const R per_x(1.0f / (found.a * found.a)), per_y(1.0f / (found.b * found.b));
  const R ahead = multiply_add(local.x * per_x, way.x, local.y * per_y * way.y);
  const R to_rim = until_sphere(inside, -ahead, square - R(1), found.square_of(way));
  border.offer(select(behind, R(never), to_rim));
  border.at = select(features, border.at, R(never));
  const Vec3<R> from = local - found.place(local);
  const Vec3<R> rate{way.x - found.speed_x(way), way.y - found.speed_y(way), way.z};
  const R apart2 = dot(from, from), outside = apart2 - R(gate.reach2);
  const auto reached = outside < R(0);
  border.offer(select(reached, until_sphere(-dot(from, rate), outside, dot(rate, rate)),
                      until_near(gate, found, local, way)));
  return border;
}

}  // namespace portalens
