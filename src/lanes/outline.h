/// \file
/// Over lanes: the nearest point of a portal that is any convex polygon, by the one-sided rule, and
/// where what decides it changes along a path. `rectangle.h` for all shapes.
#pragma once

#include "lanes/border.h"
#include "lanes/face_axes.h"
#include "lanes/first_meeting.h"

namespace portalens {

/// Distance of a place in its plane from an edge's line, to the outside.
template <class R>
[[nodiscard]] R outside_of(const LaneEdge& edge, R x, R y) {
  return multiply_add(R(edge.along_y), x, subtract_product(R(-edge.out), R(edge.along_x), y));
}

/// Whether a place in its plane lies within an outline, its rim included.
template <class R>
[[nodiscard]] typename R::Mask covers(const LaneOutline& outline, R x, R y) {
  if (outline.kind == LaneOutline::Kind::ellipse) {
    const R u = x * R(outline.per_x), v = y * R(outline.per_y);
    return multiply_add(u, u, v * v) <= R(1);
  }
  if (outline.kind == LaneOutline::Kind::simple) {
    // Edges to the right of it, an odd number where it lies within.
    auto odd = R(1) < R(0);
    for (int k = 0; k < outline.count; ++k) {
      const LaneEdge& edge = outline.edges[k];
      const R out = outside_of(edge, x, y) * R(edge.along_y > 0.0f ? 1.0f : -1.0f);
      odd = odd ^ (((R(edge.start_y) <= y) ^ (R(edge.end_y) <= y)) & (out < R(0)));
    }
    return odd;
  }
  auto within = R(0) < R(1);
  for (int k = 0; k < outline.count; ++k)
    within = within & (outside_of(outline.edges[k], x, y) <= R(0));
  return within;
}

/// A line in a face's plane, and heights over it.
template <class R>
struct LaneLine {
  R x, y, offset;

  [[nodiscard]] static LaneLine along(const LaneEdge& edge) {
    return {R(edge.along_x), R(edge.along_y), R(edge.begin)};
  }
  /// Rounds as `outside_of` does.
  [[nodiscard]] static LaneLine outside(const LaneEdge& edge) {
    return {R(edge.along_y), R(-edge.along_x), R(edge.out)};
  }

  [[nodiscard]] R height(Vec3<R> local) const {
    return multiply_add(x, local.x, multiply_add(y, local.y, -offset));
  }
  [[nodiscard]] R rate(Vec3<R> way) const { return multiply_add(x, way.x, y * way.y); }
  /// Of the plane through it that is upright on the face.
  [[nodiscard]] Vec3<R> normal() const { return {x, y, R(0)}; }
  /// At most that of a height.
  [[nodiscard]] R sway(Vec3<R> of) const { return multiply_add(abs(x), of.x, abs(y) * of.y); }
  [[nodiscard]] LaneQuintic<R, R> height(const LocalPath<R>& path) const {
    return path.x * x + path.y * y + -offset;
  }
  void take(typename R::Mask where, const LaneLine& other) {
    x = select(where, other.x, x);
    y = select(where, other.y, y);
    offset = select(where, other.offset, offset);
  }
};

/// The nearest point of a feature whose nearest point is linear in a place:
///     q = keep · local + fix      in the plane, with a symmetric matrix
template <class R>
struct LaneLinearNearest {
  using Mask = typename R::Mask;

  R keep_xx, keep_xy, keep_yy, fix_x, fix_y;

  [[nodiscard]] R x(Vec3<R> local) const {
    return multiply_add(keep_xx, local.x, multiply_add(keep_xy, local.y, fix_x));
  }
  [[nodiscard]] R y(Vec3<R> local) const {
    return multiply_add(keep_xy, local.x, multiply_add(keep_yy, local.y, fix_y));
  }
  [[nodiscard]] Vec3<R> place(Vec3<R> local) const { return {x(local), y(local), R(0)}; }
  /// 1 where the nearest point moves as the photon does, be it along an edge only; else 0.
  [[nodiscard]] R moves() const { return min(keep_xx + keep_yy, R(1)); }
  [[nodiscard]] R speed_x(Vec3<R> way) const {
    return multiply_add(keep_xx, way.x, keep_xy * way.y);
  }
  [[nodiscard]] R speed_y(Vec3<R> way) const {
    return multiply_add(keep_xy, way.x, keep_yy * way.y);
  }
  [[nodiscard]] R sway_x(Vec3<R> sway) const {
    return multiply_add(abs(keep_xx), sway.x, abs(keep_xy) * sway.y);
  }
  [[nodiscard]] R sway_y(Vec3<R> sway) const {
    return multiply_add(abs(keep_xy), sway.x, abs(keep_yy) * sway.y);
  }
  [[nodiscard]] LocalPath<R> led_by(const LocalPath<R>& path) const {
    return {path.x * keep_xx + path.y * keep_xy + fix_x,
            path.x * keep_xy + path.y * keep_yy + fix_y,
            {}};
  }

  /// Of the other only where its nearest point is.
  void take(Mask where, const LaneLinearNearest& other) {
    keep_xx = select(where, other.keep_xx, keep_xx);
    keep_xy = select(where, other.keep_xy, keep_xy);
    keep_yy = select(where, other.keep_yy, keep_yy);
    fix_x = select(where, other.fix_x, fix_x);
    fix_y = select(where, other.fix_y, fix_y);
  }
};

/// The feature of a polygon that is nearest, its inside, an edge's line or a vertex, and where it
/// stays so: what decides it is compared with the same numbers here and there.
template <class R>
struct LaneOutlineNearest : LaneLinearNearest<R> {
  using Mask = typename R::Mask;

  /// Of an edge, how far along it a place is, from 0 to `size`, and how far out, above 0. Of a
  /// vertex, the same along the edge after it, below 0, and how far beyond the one before it.
  LaneLine<R> along, out;
  R size;    ///< 0 of a vertex
  R beyond;  ///< it is nearest only where the height over `out` is above this
  /// `within` is 1 inside the outline, `behind` 1 inside it and behind the plane; else they are 0.
  /// Inside, `out` is that of the nearest edge.
  R within, behind;

  /// @param gate  has `outline`, and `tolerance`: heights down to minus this count as in front
  template <class Gate>
  [[nodiscard]] static LaneOutlineNearest on(const Gate& gate, Vec3<R> local) {
    const Rim rim(*gate.outline, local);
    const Mask behind = (!rim.outside) & (local.z < R(-gate.tolerance));
    const Mask over = (!rim.outside) & !behind, at_vertex = rim.outside & (rim.vertex > R(0));
    const LaneLine<R>& edge = rim.edge;
    const LaneLine<R> line{edge.y, -edge.x, rim.out};
    LaneOutlineNearest nearest_point;
    nearest_point.within = select(rim.outside, R(0), R(1));
    nearest_point.behind = select(behind, R(1), R(0));
    const R slides = select(at_vertex, R(0), R(1)), begin = select(at_vertex, edge.offset, R(0));
    nearest_point.keep_xx = select(over, R(1), slides * edge.x * edge.x);
    nearest_point.keep_xy = select(over, R(0), slides * edge.x * edge.y);
    nearest_point.keep_yy = select(over, R(1), slides * edge.y * edge.y);
    nearest_point.fix_x = select(over, R(0), multiply_add(begin, edge.x, line.offset * line.x));
    nearest_point.fix_y = select(over, R(0), multiply_add(begin, edge.y, line.offset * line.y));
    nearest_point.along = edge;
    nearest_point.out = line;
    nearest_point.out.take(at_vertex, rim.before);
    nearest_point.size = slides * rim.size;
    nearest_point.beyond = select(at_vertex, rim.size_before, R(0));
    return nearest_point;
  }

  /// How far on the path leaves the region along `along`: at either end of an edge.
  [[nodiscard]] R to_end(R place, R speed) const {
    return place - select(speed > R(0), size, R(0));
  }

 private:
  /// What of the rim is nearest: the strip of an edge, or the wedge of the vertex that it begins
  /// with, which it lies in. From inside, the nearest line.
  struct Rim {
    Mask outside;
    LaneLine<R> edge{R(0), R(0), R(0)}, before = edge;  ///< along the edge, and the one before
    R out{0}, size{0}, size_before{0};
    R vertex{0};  ///< 1: not the edge is nearest but where it begins

    Rim(const LaneOutline& outline, Vec3<R> local) : outside(R(1) < R(0)) {
      Mask open = R(0) < R(1);
      R most(-never);
      const LaneEdge* last = &outline.edges[outline.count - 1];
      R past = LaneLine<R>::along(*last).height(local) - R(last->length);
      for (int k = 0; k < outline.count; ++k) {
        const LaneEdge& here = outline.edges[k];
        const auto its_edge = LaneLine<R>::along(here);
        const R place = its_edge.height(local), height = outside_of(here, local.x, local.y);
        const R its_past = place - R(here.length);
        const Mask out_here = height > R(0), begun = place > R(0);
        const Mask wedge = (past > R(0)) & !begun;
        const Mask strip = out_here & begun & !(its_past > R(0));
        const Mask found = open & (wedge | strip | (height > most));
        edge.take(found, its_edge);
        before.take(found, LaneLine<R>::along(*last));
        out = select(found, R(here.out), out);
        size = select(found, R(here.length), size);
        size_before = select(found, R(last->length), size_before);
        vertex = select(found, select(wedge, R(1), R(0)), vertex);
        most = max(most, height);
        open = open & !(wedge | strip);
        outside = outside | out_here;
        past = its_past;
        last = &here;
      }
    }
  };
};

/// Where the place that `nearest_point` was found for lies right behind a polygon.
template <class R, class Gate>
[[nodiscard]] typename R::Mask is_behind(const Gate&, const LaneOutlineNearest<R>& nearest_point,
                                         Vec3<R>) {
  return nearest_point.behind > R(0);
}

/// Where another feature than that of `nearest_point` is nearest.
template <class R, class Gate>
[[nodiscard]] typename R::Mask has_other_nearest(const Gate& gate,
                                                 const LaneOutlineNearest<R>& nearest_point,
                                                 Vec3<R> local) {
  const R place = nearest_point.along.height(local), out = nearest_point.out.height(local);
  const auto on_edge = nearest_point.size > R(0);
  const auto other = (place - nearest_point.size > R(0)) | (on_edge & !(place > R(0))) |
                     !(out - nearest_point.beyond > R(0));
  const auto within = nearest_point.within > R(0), behind = nearest_point.behind > R(0);
  if (!any(within)) return other;
  const auto below = local.z < R(-gate.tolerance);
  auto leaves = (below & !behind) | (behind & !below);
  const R most = select(behind, min(out, R(0)), R(0));
  for (int k = 0; k < gate.outline->count; ++k)
    leaves = leaves | (outside_of(gate.outline->edges[k], local.x, local.y) > most);
  return (within & leaves) | ((!within) & other);
}

/// True only where the feature of `nearest_point` stays the nearest along a path.
/// @param start, end  of the path
/// @param sway        of each coordinate, as of `keeps_margin`
template <class R, class Gate>
[[nodiscard]] typename R::Mask keeps_nearest(const Gate& gate,
                                             const LaneOutlineNearest<R>& nearest_point,
                                             Vec3<R> start, Vec3<R> end, Vec3<R> sway) {
  const R place0 = nearest_point.along.height(start), place1 = nearest_point.along.height(end);
  const R out0 = nearest_point.out.height(start), out1 = nearest_point.out.height(end);
  const R along = nearest_point.along.sway(sway), aside = nearest_point.out.sway(sway);
  const auto on_edge = nearest_point.size > R(0);
  const auto beside =
      keeps_margin(nearest_point.size - place0, nearest_point.size - place1, along) &
      ((!on_edge) | keeps_margin(place0, place1, along)) &
      keeps_margin(out0 - nearest_point.beyond, out1 - nearest_point.beyond, aside);
  const auto within = nearest_point.within > R(0), behind = nearest_point.behind > R(0);
  if (!any(within)) return beside;
  const R z0 = start.z + R(gate.tolerance), z1 = end.z + R(gate.tolerance);
  auto keeps = keeps_margin(abs(z0), select(behind, -z1, z1), sway.z);
  const R most0 = select(behind, min(out0, R(0)), R(0)),
          most1 = select(behind, min(out1, R(0)), R(0));
  const R also = select(behind, aside, R(0));
  for (int k = 0; k < gate.outline->count; ++k) {
    const auto edge = LaneLine<R>::outside(gate.outline->edges[k]);
    keeps = keeps & keeps_margin(most0 - edge.height(start), most1 - edge.height(end),
                                 edge.sway(sway) + also);
  }
  return (within & keeps) | ((!within) & beside);
}

/// Where the nearest feature changes within a span, at whose end it has.
template <class R, class Gate>
[[gnu::noinline]] void offer_borders(FirstMeeting<R>& first, const Gate& gate,
                                     const LaneOutlineNearest<R>& nearest_point,
                                     typename R::Mask may, const LocalPath<R>& path,
                                     LaneSpan<R> span) {
  const auto within = may & (nearest_point.within > R(0)),
             beside = may & !(nearest_point.within > R(0));
  const auto along = nearest_point.along.height(path), out = nearest_point.out.height(path);
  auto met = first.offer(beside, along, span) |
             first.offer(beside, along + -nearest_point.size, span) |
             first.offer(may, out + -nearest_point.beyond, span);
  if (any(within)) {
    met = met | first.offer(within, path.z, span);
    const auto behind = within & (nearest_point.behind > R(0)), over = within & !behind;
    for (int k = 0; k < gate.outline->count; ++k) {
      const auto height = LaneLine<R>::outside(gate.outline->edges[k]).height(path);
      met = met | first.offer(over, height, span) | first.offer(behind, height - out, span);
    }
  }
  first.miss(may & !met, span);
}

/// Where, straight on but for how the path turns at first, the nearest feature changes or the
/// distance to it passes the reach.
/// @param gate  has besides `reach2`
/// @param features  whether it matters which is nearest
/// @param way   direction, in local coordinates like `local`
/// @param turn  its rate of change, in the same
template <class R, class Gate>
[[nodiscard]] LaneBorder<R> until_other_nearest(const Gate& gate,
                                                const LaneOutlineNearest<R>& nearest_point,
                                                typename R::Mask features, Vec3<R> local,
                                                Vec3<R> way, Vec3<R> turn) {
  FirstPlane<R> first;
  const auto within = nearest_point.within > R(0), behind = nearest_point.behind > R(0);
  const R speed = nearest_point.along.rate(way), place = nearest_point.along.height(local);
  first.offer(select(within, R(0), nearest_point.to_end(place, speed)), speed,
              nearest_point.along.rate(turn), nearest_point.along.normal());
  const R out = nearest_point.out.height(local), out_rate = nearest_point.out.rate(way),
          out_turn = nearest_point.out.rate(turn);
  first.offer(out - nearest_point.beyond, out_rate, out_turn, nearest_point.out.normal());
  if (any(within)) {
    // Over the polygon all edges may be next; behind it those that are as near as the nearest.
    const R less = select(behind, R(1), R(0));
    const auto also = [&](auto its, auto of_nearest) { return its - of_nearest * less; };
    FirstPlane<R> inner = first;
    inner.offer(local.z, way.z, turn.z, {R(0), R(0), R(1)});
    for (int k = 0; k < gate.outline->count; ++k) {
      const auto edge = LaneLine<R>::outside(gate.outline->edges[k]);
      inner.offer(also(edge.height(local), out), also(edge.rate(way), out_rate),
                  also(edge.rate(turn), out_turn), also(edge.normal(), nearest_point.out.normal()));
    }
    first.take(within, inner);
  }
  const Vec3<R> from = local - nearest_point.place(local);
  const Vec3<R> rate{way.x - nearest_point.speed_x(way), way.y - nearest_point.speed_y(way), way.z};
  const Vec3<R> bent{turn.x - nearest_point.speed_x(turn), turn.y - nearest_point.speed_y(turn),
                     turn.z};
  const R outside = dot(from, from) - R(gate.reach2);
  const R straight = until_sphere(-dot(from, rate), outside, dot(rate, rate));
  // By one step of Newton's method from the straight path.
  const Vec3<R> at = from + (rate + bent * (straight * R(0.5))) * straight;
  const R more = (R(gate.reach2) - dot(at, at)) / (R(2) * dot(at, rate + bent * straight));
  const R ends = select(abs(more) < straight * R(0.5), straight + more, straight);
  LaneBorder<R> border = first.along_the_curve();
  border.at = select(features, border.at, R(never));
  border.offer(ends);
  return border;
}

}  // namespace portalens
