/// \file
/// Over lanes: how the shortest path to the image of a mass passes a portal that is any simple
/// polygon. `rim.h` for all shapes.
#pragma once

#include "lanes/outline.h"
#include "lanes/rim.h"

namespace portalens {

/// As a `LaneRim`, of the face's outline.
template <class R>
struct LaneOutlineRim {
  using Mask = typename R::Mask;
  using Margin = LaneRimMargin<R>;

  /// How a path passes the rim: over an edge's line, or over a vertex.
  struct Passage {
    R code;                   ///< 0: out of reach, 1: straight, else one number for each feature
    R along_x, along_y, out;  ///< the edge's line, as of a `LaneEdge`
    R place;                  ///< along it
    R slides;                 ///< 1 inside of the edge, 0 at a vertex
    Margin margin;
  };
  /// What of a passage stays frozen.
  struct Held {
    R gm;  ///< 0 out of reach
    R straight, along_x, along_y, out, off;
    R slides, place;
  };

  [[nodiscard]] static Passage shortest(const LaneFace& face, const LaneWay& way, Vec3<R> a) {
    const LaneOutline& outline = *face.outline;
    const Vec3<R> b = spread<R>(way.image);
    Passage best{R(0), R(1), R(0), R(0), R(0), R(0), {R(0), R(0)}};
    LaneLeastWay<R> ways;
    for (int k = 0; k < outline.count; ++k) {
      const LaneEdge& edge = outline.edges[k];
      const LaneLine<R> along = LaneLine<R>::along(edge), out = LaneLine<R>::outside(edge);
      const BesideLine<R> ends{along.height(a), off(out.height(a), a), along.height(b),
                               off(out.height(b), b)};
      const RimWay<R> found = over_rim(ends, R(edge.length));
      const Mask low = found.place <= R(0), high = found.place >= R(edge.length);
      const int next = k + 1 < outline.count ? k + 1 : 0;
      const R code = select(low, vertex(k), select(high, vertex(next), R(2 + k)));
      const Mask better = ways.offer(code, found.length);
      best.along_x = select(better, R(edge.along_x), best.along_x);
      best.along_y = select(better, R(edge.along_y), best.along_y);
      best.out = select(better, R(edge.out), best.out);
      best.place = select(better, found.place + R(edge.begin), best.place);
      best.slides = select(better, select(low | high, R(0), R(1)), best.slides);
    }
    const auto on = [&](R x, R y) { return covers(outline, x, y); };
    ways.conclude(way, b - a, straight_through(face, a, b, on), best);
    return best;
  }

  /// Which part of the path from a to b, as shares, lies where the image may be seen through the
  /// face: before it, within the pyramid over it whose top is the image; of a face that is not
  /// convex, over the edges that end in no notch. Nothing where low >= high.
  [[nodiscard]] static LaneSpan<R> open_between(const LaneFace& face, const LaneWay& way, Vec3<R> a,
                                                Vec3<R> b) {
    const LaneOutline& outline = *face.outline;
    const Vec3<R> image = spread<R>(way.image);
    LaneOpenSpan<R> open(image.z <= R(face.tolerance));
    open.keep(a.z, b.z);
    for (int k = 0; k < outline.count; ++k) {
      const LaneEdge& edge = outline.edges[k];
      const int next = k + 1 < outline.count ? k + 1 : 0;
      if (edge.reentrant > 0.0f || outline.edges[next].reentrant > 0.0f) continue;
      // Where the line from a place to the image crosses the plane, times how far that is before
      // the image.
      const auto inside = [&](Vec3<R> p) {
        const Vec3<R> crossing = image * p.z - p * image.z;
        return R(edge.out) * (p.z - image.z) -
               subtract_product(R(edge.along_y) * crossing.x, R(edge.along_x), crossing.y);
      };
      open.keep(inside(a), inside(b));
    }
    return open.span;
  }

  /// Where a path from a to b bends over the rim: an edge counts as its whole line.
  [[nodiscard]] static Vec3<R> bend(const Held& held, Vec3<R> a, Vec3<R> b) {
    const auto along = [&](Vec3<R> p) {
      return multiply_add(held.along_x, p.x, held.along_y * p.y);
    };
    const R aside = subtract_product(held.along_y * a.x - held.out, held.along_x, a.y);
    const BesideLine<R> ends{along(a), off(aside, a), along(b), held.off};
    const R place = select(held.slides > R(0), ends.meeting(), held.place);
    return {multiply_add(place, held.along_x, held.out * held.along_y),
            subtract_product(place * held.along_y, held.out, held.along_x), R(0)};
  }

  static void freeze(const LaneWay& way, const Passage& passage, Held& held) {
    held.gm = select(passage.code > R(0), R(way.gm), R(0));
    held.straight = select(passage.code == R(1), R(1), R(0));
    held.along_x = passage.along_x;
    held.along_y = passage.along_y;
    held.out = passage.out;
    const Vec3<R> b = spread<R>(way.image);
    held.off = off(subtract_product(passage.along_y * b.x - passage.out, passage.along_x, b.y), b);
    held.slides = passage.slides;
    held.place = passage.place;
  }

 private:
  [[nodiscard]] static R vertex(int index) { return R(2 + max_lane_edges + index); }
  /// The distance of a place from a line in the plane.
  [[nodiscard]] static R off(R aside, Vec3<R> place) {
    return sqrt(multiply_add(aside, aside, place.z * place.z));
  }
};

}  // namespace portalens
