/// \file
/// Over lanes: how the shortest path to the image of a mass passes a rectangular portal, straight
/// or over its rim, and where that may change.
#pragma once

#include "gravity/way_formulas.h"
#include "lanes/border.h"
#include "lanes/face_axes.h"
#include "lanes/path.h"
#include "lanes/scene.h"

namespace portalens {

/// How far a passage is from changing, as lengths. Where the place moves by d, `beyond` changes by
/// at most d, and `lead` by at most 2 d.
template <class R>
struct LaneRimMargin {
  R beyond;  ///< how much longer than the influence it is
  R lead;    ///< how much shorter than that over another feature of the rim
};

/// Looks where a margin that is positive at two places may vanish between them: first at the
/// bottom of the valley that it would fall into and come out of as steeply as it may.
/// @param slope  the most that it changes by over the whole step
/// @param at     the margin there
template <class R, class At>
void seek_margin(typename R::Mask may, LaneSpan<R> span, R low, R high, R slope, const At& at) {
  constexpr int seeks = 4;
  const auto bottom = [&](R a, R b, R width) { return a + b - slope * width; };
  for (int i = 0; i < seeks; ++i) {
    const R width = span.high - span.low;
    may = may & (bottom(low, high, width) < R(0)) & (min(low, high) > R(0));
    if (!any(may)) return;
    const R u = span.low + min(max((low - high) / slope + width, R(0)) * R(0.5), width);
    const R here = at(may, u);
    // What is convex is least beside the lower of two neighbours.
    const auto deep = here < min(low, high);
    const auto deeper = bottom(low, here, u - span.low) < bottom(here, high, span.high - u);
    const auto before = (deep & deeper) | ((!deep) & (low < high));
    span = {select(before, span.low, u), select(before, u, span.high)};
    low = select(before, low, here);
    high = select(before, here, high);
  }
}

/// The part of a path, as shares, where all that is asked of it is positive.
template <class R>
struct LaneOpenSpan {
  LaneSpan<R> span;

  /// @param may  else nothing is
  explicit LaneOpenSpan(typename R::Mask may) : span{R(0), select(may, R(1), R(0))} {}
  /// Of what changes evenly between the ends of the path.
  void keep(R at_start, R at_end) {
    const R zero = at_start / (at_start - at_end);
    span.low = select(at_start < R(0), select(at_end < R(0), R(2), max(span.low, zero)), span.low);
    span.high = select((at_end < R(0)) & (at_start >= R(0)), min(span.high, zero), span.high);
  }
};

/// The shortest of the ways over the edges of a rim.
template <class R>
struct LaneLeastWay {
  using Mask = typename R::Mask;
  R least = R(never), second = R(never);  ///< lengths; the second over another feature
  R feature = R(0);

  /// Takes one more; where it is the shortest so far.
  /// @param code  of the feature: a vertex is met along two edges
  Mask offer(R code, R length) {
    const Mask better = length < least;
    const R longer = select(better, least, length);
    second = select(code == feature, second, min(second, longer));
    least = select(better, length, least);
    feature = select(better, code, feature);
    return better;
  }
  /// Of the whole passage: straight where the face is `open` for that, else over the rim.
  /// @param to  from the place to the image
  template <class Passage>
  void conclude(const LaneWay& way, Vec3<R> to, Mask open, Passage& passage) const {
    const R influence(way.influence), direct = dot(to, to);
    const Mask near = (open & (direct < influence * influence)) | ((!open) & (least < influence));
    passage.code = select(near, select(open, R(1), feature), R(0));
    passage.margin = {select(open, sqrt(direct), least) - influence, second - least};
  }
};

/// Whether the segment from a to b crosses a face from front to back.
/// @param covers  whether a point of the plane, x and y, lies on the face
template <class R, class Covers>
[[nodiscard]] typename R::Mask straight_through(const LaneFace& face, Vec3<R> a, Vec3<R> b,
                                                const Covers& covers) {
  const R above = max(a.z, R(0)), below = max(-b.z, R(0));
  const R t = select(above > R(0), above / (above + below), R(0));
  return (a.z >= R(-face.tolerance)) & (b.z <= R(face.tolerance)) &
         covers(a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t);
}

/// Of a rectangle. Places are in the local coordinates of the face.
template <class R>
struct LaneRim {
  using Mask = typename R::Mask;
  using Margin = LaneRimMargin<R>;

  /// How a path passes the rim: over the edge along x or y on the line at `side`, or over a vertex.
  struct Passage {
    R code;  ///< 0: out of reach, 1: straight, else one number for each feature
    R along_x, side, place;
    R slides;  ///< 1 inside of the edge, 0 at a vertex
    Margin margin;
  };
  /// What of a passage stays frozen.
  struct Held {
    R gm;  ///< 0 out of reach
    R straight, along_x, side, off;
    R slides, place;
  };

  [[nodiscard]] static Passage shortest(const LaneFace& face, const LaneWay& way, Vec3<R> a) {
    const R w(face.half_width), h(face.half_height);
    const Vec3<R> b = spread<R>(way.image);
    // Over each edge in turn, below, right, above, left.
    Passage best{R(0), R(1), R(0), R(0), R(0), {R(0), R(0)}};
    LaneLeastWay<R> ways;
    for (int k = 0; k < 4; ++k) {
      const bool along_x = k % 2 == 0;
      const R half = along_x ? w : h;
      const R side = along_x ? (k == 0 ? -h : h) : (k == 1 ? w : -w);
      const R aside = (along_x ? a.y : a.x) - side;
      const BesideLine<R> ends{(along_x ? a.x : a.y) + half, sqrt(aside * aside + a.z * a.z),
                               (along_x ? b.x : b.y) + half, R(way.off[k])};
      const RimWay<R> found = over_rim(ends, half * R(2));
      const Mask low = found.place <= R(0), high = found.place >= half * R(2);
      // Vertices count from the lower left; the first of edge 0 is 0, its last is 1, and so on.
      const int first = k < 2 ? k : (k == 2 ? 3 : 0), last = k < 2 ? k + 1 : (k == 2 ? 2 : 3);
      const R code = select(low, R(6 + first), select(high, R(6 + last), R(2 + k)));
      const Mask better = ways.offer(code, found.length);
      best.along_x = select(better, R(along_x ? 1 : 0), best.along_x);
      best.side = select(better, side, best.side);
      best.place = select(better, found.place - half, best.place);
      best.slides = select(better, select(low | high, R(0), R(1)), best.slides);
    }
    const auto covers = [&](R x, R y) {
      return (abs(x) <= R(face.half_width)) & (abs(y) <= R(face.half_height));
    };
    ways.conclude(way, b - a, straight_through(face, a, b, covers), best);
    return best;
  }

  /// Which part of the path from a to b, as shares, lies where the image is seen through the face:
  /// before it, within the pyramid over it whose top is the image. Nothing where low >= high.
  [[nodiscard]] static LaneSpan<R> open_between(const LaneFace& face, const LaneWay& way, Vec3<R> a,
                                                Vec3<R> b) {
    const Vec3<R> image = spread<R>(way.image);
    LaneOpenSpan<R> open(image.z <= R(face.tolerance));
    open.keep(a.z, b.z);
    const R from_a = a.z - image.z, from_b = b.z - image.z;
    const auto between = [&](R at_a, R at_b, R top, R half) {
      const R aside_a = top * a.z - image.z * at_a, aside_b = top * b.z - image.z * at_b;
      open.keep(half * from_a - aside_a, half * from_b - aside_b);
      open.keep(half * from_a + aside_a, half * from_b + aside_b);
    };
    between(a.x, b.x, image.x, R(face.half_width));
    between(a.y, b.y, image.y, R(face.half_height));
    return open.span;
  }

  /// Where a path from a to b bends over the rim: an edge counts as its whole line.
  [[nodiscard]] static Vec3<R> bend(const Held& held, Vec3<R> a, Vec3<R> b) {
    const Mask along_x = held.along_x > R(0);
    const R aside = select(along_x, a.y, a.x) - held.side;
    const BesideLine<R> ends{select(along_x, a.x, a.y), sqrt(aside * aside + a.z * a.z),
                             select(along_x, b.x, b.y), held.off};
    const R place = select(held.slides > R(0), ends.meeting(), held.place);
    return {select(along_x, place, held.side), select(along_x, held.side, place), R(0)};
  }

  static void freeze(const LaneWay& way, const Passage& passage, Held& held) {
    held.gm = select(passage.code > R(0), R(way.gm), R(0));
    held.straight = select(passage.code == R(1), R(1), R(0));
    held.along_x = passage.along_x;
    held.side = passage.side;
    const Vec3<R> b = spread<R>(way.image);
    const R aside = select(passage.along_x > R(0), b.y, b.x) - passage.side;
    held.off = sqrt(aside * aside + b.z * b.z);
    held.slides = passage.slides;
    held.place = passage.place;
  }
};

}  // namespace portalens
