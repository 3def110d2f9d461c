/// \file
/// Over lanes: the nearest point of a portal that is any simple polygon, by the one-sided rule, and
/// where what decides it changes along a path. `outline.h` for what need not be convex: what is
/// nearest is compared with all edges, and stays so within a ball of which
/// `distance_to_discontinuity` is the radius.
#pragma once

#include "lanes/outline.h"

namespace portalens {

/// The feature of a polygon that is nearest, as of a `LaneOutlineNearest`.
template <class R>
struct LaneSimpleNearest : LaneLinearNearest<R> {
  using Mask = typename R::Mask;

  /// -1: the inside; 2k: the vertex where edge k begins; 2k + 1: edge k. Right behind the face
  /// `right_behind` is added, so that to leave that region counts as a change even where the same
  /// edge is nearest afterwards.
  R feature;
  static constexpr float right_behind = 2.0f * max_lane_edges;
  R distance_to_discontinuity;  ///< within this distance the nearest point does not jump
  R rim;                        ///< the distance from the rim, in the plane
  /// Of an edge, how far along it a place is, from 0 to `size`. Of a vertex, the same along the
  /// edge after it, below 0, and how far beyond the one before it, above 0.
  LaneLine<R> along{R(0), R(0), R(0)}, before = along;
  R size{0}, size_before{0};

  void take(Mask where, const LaneSimpleNearest& other) {
    LaneLinearNearest<R>::take(where, other);
    feature = select(where, other.feature, feature);
  }

  /// Of an edge, how far a place lies to its outside, and by how much that may sway.
  [[nodiscard]] R outside(Vec3<R> local) const {
    return multiply_add(local.x - this->x(local), along.y, -((local.y - this->y(local)) * along.x));
  }
  [[nodiscard]] R sway_outside(Vec3<R> sway) const {
    return multiply_add(abs(along.y), sway.x, abs(along.x) * sway.y);
  }

  /// @param gate  has `outline`, and `tolerance`
  template <class Gate>
  [[nodiscard]] static LaneSimpleNearest on(const Gate& gate, Vec3<R> local) {
    const LaneOutline& outline = *gate.outline;
    LaneSimpleNearest nearest_point;
    R least2(never), edge(0);
    nearest_point.feature = R(0);
    const LaneEdge* last = &outline.edges[outline.count - 1];
    for (int k = 0; k < outline.count; ++k) {
      const LaneEdge& here = outline.edges[k];
      const Part part(here, local);
      const Mask inner = (part.place > R(0)) & (part.place < R(here.length));
      // Between insides of edges as near the lower index wins.
      const Mask among_insides = inner & (nearest_point.size > R(0));
      const Mask nearer = part.square < select(among_insides, least2 * R(0.999999), least2);
      const Mask at_end = !(part.place < R(here.length));
      const LaneEdge& next = outline.edges[k + 1 < outline.count ? k + 1 : 0];
      least2 = select(nearer, part.square, least2);
      edge = select(nearer, R(k), edge);
      const int after = k + 1 < outline.count ? k + 1 : 0;
      const R found = select(inner, R(2 * k + 1), select(at_end, R(2 * after), R(2 * k)));
      nearest_point.feature = select(nearer, found, nearest_point.feature);
      nearest_point.along.take(nearer & !at_end, LaneLine<R>::along(here));
      nearest_point.along.take(nearer & at_end, LaneLine<R>::along(next));
      nearest_point.before.take(nearer & !at_end, LaneLine<R>::along(*last));
      nearest_point.before.take(nearer & at_end, LaneLine<R>::along(here));
      nearest_point.size = select(nearer, select(inner, R(here.length), R(0)), nearest_point.size);
      nearest_point.size_before = select(nearer, select(at_end, R(here.length), R(last->length)),
                                         nearest_point.size_before);
      nearest_point.fix_x =
          select(nearer, select(inner, R(here.out * here.along_y), part.x), nearest_point.fix_x);
      nearest_point.fix_y =
          select(nearer, select(inner, R(-here.out * here.along_x), part.y), nearest_point.fix_y);
      last = &here;
    }
    nearest_point.rim = sqrt(least2);
    const Mask inside = covers(outline, local.x, local.y);
    const Mask before_plane = !(local.z < R(-gate.tolerance)), over = inside & before_plane;
    const Mask slides = nearest_point.size > R(0);
    nearest_point.keep_xx =
        select(over, R(1), select(slides, nearest_point.along.x * nearest_point.along.x, R(0)));
    nearest_point.keep_xy =
        select(over, R(0), select(slides, nearest_point.along.x * nearest_point.along.y, R(0)));
    nearest_point.keep_yy =
        select(over, R(1), select(slides, nearest_point.along.y * nearest_point.along.y, R(0)));
    nearest_point.fix_x = select(over, R(0), nearest_point.fix_x);
    nearest_point.fix_y = select(over, R(0), nearest_point.fix_y);
    nearest_point.feature = select(over, R(-1), nearest_point.feature);
    nearest_point.feature = select(inside & !before_plane, nearest_point.feature + R(right_behind),
                                   nearest_point.feature);
    nearest_point.distance_to_discontinuity =
        calm_at(outline, local, edge, nearest_point.rim, inside, before_plane);
    return nearest_point;
  }

 private:
  /// The place of an edge that is nearest.
  struct Part {
    R place, x, y, square;

    Part(const LaneEdge& edge, Vec3<R> local)
        : place(LaneLine<R>::along(edge).height(local)), x(R(0)), y(R(0)), square(R(0)) {
      const R out = outside_of(edge, local.x, local.y);
      const R held = min(max(place, R(0)), R(edge.length));
      const R aside = place - held, at = held + R(edge.begin);
      x = multiply_add(at, R(edge.along_x), R(edge.out * edge.along_y));
      y = multiply_add(at, R(edge.along_y), R(-edge.out * edge.along_x));
      square = multiply_add(aside, aside, out * out);
    }
  };

  /// As `ConcavePolygon::distance_to_discontinuity`.
  [[nodiscard]] static R calm_at(const LaneOutline& outline, Vec3<R> local, R edge, R rim,
                                 Mask inside, Mask before_plane) {
    R bound = max(abs(local.z), select(inside, R(0), rim));
    const int count = outline.count;
    const Mask inwards = inside & !before_plane, only_outside = inside & before_plane;
    for (int k = 0; k < count; ++k) {
      R lead = R(0.5) * (sqrt(Part(outline.edges[k], local).square) - rim);
      lead = select(only_outside, max(lead, rim), lead);
      const Mask follows = edge == R(k > 0 ? k - 1 : count - 1);
      const Mask leads = edge == R(k + 1 < count ? k + 1 : 0);
      const int after = k + 1 < count ? k + 1 : 0;
      const Mask opens_outwards =
          select(follows, R(outline.edges[k].reentrant), R(outline.edges[after].reentrant)) > R(0);
      const Mask friendly = (follows | leads) & !(opens_outwards ^ inwards);
      const R other = select(friendly, select(before_plane, R(never), max(lead, rim)), lead);
      bound = select(edge == R(k), bound, min(bound, other));
    }
    // Less what floats can't tell.
    return max(bound * R(0.999) - R(1e-6) * (rim + R(outline.longest)), R(0));
  }
};

/// True everywhere: what `stays_out_of` takes for granted elsewhere holds for convex faces only.
template <class R, class Gate>
[[nodiscard]] typename R::Mask is_behind(const Gate&, const LaneSimpleNearest<R>&, Vec3<R>) {
  return R(0) < R(1);
}

/// Where another feature than that of `nearest_point` is nearest.
template <class R, class Gate>
[[nodiscard]] typename R::Mask has_other_nearest(const Gate& gate,
                                                 const LaneSimpleNearest<R>& nearest_point,
                                                 Vec3<R> local) {
  return !(LaneSimpleNearest<R>::on(gate, local).feature == nearest_point.feature);
}

/// True only where the feature of `nearest_point` stays the nearest along a path.
template <class R, class Gate>
[[nodiscard]] typename R::Mask keeps_nearest(const Gate& gate,
                                             const LaneSimpleNearest<R>& nearest_point,
                                             Vec3<R> start, Vec3<R> end, Vec3<R> sway) {
  const Vec3<R> way = end - start;
  const R moved = sqrt(dot(way, way)) + sqrt(dot(sway, sway));
  const auto over = nearest_point.feature<R(0), on_edge = nearest_point.size> R(0);
  const R place0 = nearest_point.along.height(start), place1 = nearest_point.along.height(end);
  const R past0 = nearest_point.before.height(start) - nearest_point.size_before;
  const R past1 = nearest_point.before.height(end) - nearest_point.size_before;
  const R along = nearest_point.along.sway(sway), beyond = nearest_point.before.sway(sway);
  const auto ends = keeps_margin(nearest_point.size - place0, nearest_point.size - place1, along);
  const auto begins = (on_edge & keeps_margin(place0, place1, along)) |
                      ((!on_edge) & keeps_margin(past0, past1, beyond));
  // From beside an edge it may come over the face, whose inside is then the nearest; behind the
  // plane the edge stays that.
  const R out0 = nearest_point.outside(start), out1 = nearest_point.outside(end);
  const R below0 = -start.z - R(gate.tolerance), below1 = -end.z - R(gate.tolerance);
  const auto stays_behind = (below0 > R(0)) & keeps_margin(below0, below1, sway.z);
  const auto stays_beside = (!on_edge) | !(out0 > R(0)) | stays_behind |
                            keeps_margin(out0, out1, nearest_point.sway_outside(sway));
  return (moved < nearest_point.distance_to_discontinuity) &
         ((over & (moved < nearest_point.rim)) | ((!over) & ends & begins & stays_beside));
}

/// Where the nearest feature changes within a span, at whose end it has.
template <class R, class Gate>
[[gnu::noinline]] void offer_borders(FirstMeeting<R>& first, const Gate& gate,
                                     const LaneSimpleNearest<R>& nearest_point,
                                     typename R::Mask may, const LocalPath<R>& path,
                                     LaneSpan<R> span) {
  R low = span.low, high = span.high;
  for (int k = 0; k < 16; ++k) {
    const R middle = (low + high) * R(0.5);
    const auto other = has_other_nearest(
        gate, nearest_point, Vec3<R>{path.x.at(middle), path.y.at(middle), path.z.at(middle)});
    high = select(other, middle, high);
    low = select(other, low, middle);
  }
  first.share = min(first.share, select(may, high, R(2)));
}

/// Where the distance to the nearest feature passes the reach; and where a path that nothing acts
/// on surely is out of it until then.
template <class R, class Gate>
[[nodiscard]] LaneBorder<R> until_other_nearest(const Gate& gate,
                                                const LaneSimpleNearest<R>& nearest_point,
                                                typename R::Mask, Vec3<R> local, Vec3<R> way,
                                                Vec3<R>) {
  const Vec3<R> from = local - nearest_point.place(local);
  const Vec3<R> rate{way.x - nearest_point.speed_x(way), way.y - nearest_point.speed_y(way), way.z};
  const R square = dot(from, from), outside = square - R(gate.reach2);
  const auto reached = square < R(gate.reach2);
  // What is behind the plane is nearer to it at once when it has passed that.
  const R height = abs(local.z);
  const R apart = min(sqrt(square) - R(gate.reach), select(local.z < R(0), height, R(never)));
  LaneBorder<R> border;
  border.offer(
      select(reached, until_sphere(-dot(from, rate), outside, dot(rate, rate)), max(apart, R(0))));
  return border;
}

}  // namespace portalens
