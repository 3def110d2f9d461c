/// \file
/// `shortest-path` over lanes, for chains of one rectangular portal.
#pragma once

#include <algorithm>
#include <utility>

#include "gravity/way_formulas.h"
#include "lanes/pull.h"
#include "lanes/rectangle.h"
#include "lanes/scene.h"

namespace portalens {

template <class R>
class LaneShortestPath {
 public:
  using Mask = typename R::Mask;

  explicit LaneShortestPath(const LaneScene& scene) : scene_(scene), acting_(R(1) < R(0)) {}

  void decide(Vec3<R> anchor) {
    acting_ = R(1) < R(0);
    for (int e = 0; e < scene_.entrance_count; ++e) {
      const LaneEntrance& entrance = scene_.entrances[e];
      const Vec3<R> local = local_in(entrance.face, anchor);
      for (int i = entrance.first; i < entrance.end; ++i) {
        const Passage passage = shortest(entrance.face, scene_.ways[i], local);
        passed_[i] = passage.code;
        began_[i] = passage.margin;
        acting_ = acting_ | (passage.code > R(0));
        freeze(scene_.ways[i], passage, held_[i]);
      }
    }
  }
  [[nodiscard]] Mask acting() const { return acting_; }

  void add_to(BendingOf<R>& sum, Vec3<R> x, Vec3<R>) const {
    sum.acceleration += pull(x, [&](const Held& held, R square, R near2) {
      const R scale2 = way_scale2(held.straight > R(0), square, near2);
      const R inverse2 = R(1) / scale2, inverse_square = R(1) / square;
      const auto acts = held.gm > R(0);
      const R stiffness = held.gm * inverse_square * inverse2 * sqrt(inverse2);
      sum.stiffness = sum.stiffness + select(acts, stiffness * R(distant_weight), R(0));
      sum.nearness = sum.nearness + select(acts, inverse2 * inverse2, R(0));
      sum.gradient =
          sum.gradient + select(acts, R(2) * held.gm * inverse_square * sqrt(inverse2), R(0));
    });
  }

  [[nodiscard]] Vec3<R> acceleration(Vec3<R> x) const {
    return pull(x, [](const Held&, R, R) {});
  }

  /// Looked for at quarters of the step, then by halving: where paths change has no closed form.
  [[nodiscard]] LaneBorder<R> boundary(Vec3<R> x, Vec3<R> t, Vec3<R> bend, Mask, R limit) const {
    const R far = min(limit, R(scene_.farthest));
    const auto at = [&](R s) { return x + t * s + bend * (s * s * R(0.5)); };
    R good(0), bad = far;
    Mask changed = R(1) < R(0);
    for (int k = 1; k <= 4; ++k) {
      const R s = far * R(0.25 * k);
      const Mask now = differs(at(s));
      bad = select(now & !changed, s, bad);
      changed = changed | now;
      good = select(changed, good, s);
    }
    LaneBorder<R> first;
    if (!any(changed)) return first;
    for (int k = 0; k < halvings; ++k) {
      const R middle = (good + bad) * R(0.5);
      const Mask now = differs(at(middle));
      bad = select(now, middle, bad);
      good = select(now, good, middle);
    }
    first.at = select(changed, bad, R(never));
    return first;
  }

  /// As in `LaneMasses`: by halving, as `boundary`. Where what is the same at two looks may have
  /// been another between them, that is looked for there.
  void find_changes(FirstMeeting<R>& first, Mask which, const LanePath<R>& path, R over) const {
    const LaneLooks<R> looks(path, over);
    R good(0), bad(2);
    Mask changed = R(1) < R(0);
    Margin before[max_lane_ways], after[max_lane_ways];
    std::copy_n(began_, max_lane_ways, before);
    for (int k = 1; k < LaneLooks<R>::count; ++k) {
      const Mask still = which & !changed;
      if (!any(still)) break;
      const LaneSpan<R> span = looks.before(k);
      R found = select(differs(looks.place[k], after), span.high, R(2));
      for (int e = 0; e < scene_.entrance_count; ++e) {
        const LaneEntrance& entrance = scene_.entrances[e];
        const Vec3<R> from = local_in(entrance.face, looks.place[k - 1]);
        const Vec3<R> to = local_in(entrance.face, looks.place[k]);
        for (int i = entrance.first; i < entrance.end; ++i) {
          const auto passage_at = [&](R u) {
            return shortest(entrance.face, scene_.ways[i],
                            local_in(entrance.face, path.place.at(u)));
          };
          const auto tell = [&](Mask where, R u) { found = select(where, min(found, u), found); };
          const Margin &a = before[i], &b = after[i];
          const Mask out = !(passed_[i] > R(0));
          seek(still & out, span, a.beyond, b.beyond, path.h, [&](Mask may, R u) {
            const Passage passage = passage_at(u);
            tell(may & (passage.code > R(0)), u);
            return passage.margin.beyond;
          });
          seek(still & (passed_[i] > R(1)), span, a.lead, b.lead, R(2) * path.h,
               [&](Mask may, R u) {
                 const Passage passage = passage_at(u);
                 const Mask other = may & !(passage.code == passed_[i]);
                 tell(other, u);
                 return select(other, R(0), passage.margin.lead);
               });
          const LaneSpan<R> open = open_between(entrance.face, scene_.ways[i], from, to);
          const Mask may = still & !(passed_[i] == R(1)) & (open.low < open.high);
          if (!any(may)) continue;
          const R u = multiply_add(span.high - span.low, (open.low + open.high) * R(0.5), span.low);
          tell(may & !(passage_at(u).code == passed_[i]), u);
        }
      }
      const Mask now = still & (found <= R(1));
      bad = select(now, found, bad);
      changed = changed | now;
      good = select(changed, good, span.high);
      std::swap(before, after);
    }
    if (!any(changed)) return;
    for (int k = 0; k < halvings; ++k) {
      const R middle = (good + bad) * R(0.5);
      const Mask now = differs(path.place.at(middle));
      bad = select(now, middle, bad);
      good = select(now, good, middle);
    }
    first.share = select(changed, min(first.share, bad), first.share);
  }

  /// As of `LaneMasses`; paths over the rim are longer than straight ones.
  [[nodiscard]] Mask too_near(Vec3<R> x) const {
    Mask found = R(1) < R(0);
    if (!scene_.bare_through) return found;
    for (int e = 0; e < scene_.entrance_count; ++e) {
      const LaneEntrance& entrance = scene_.entrances[e];
      const Vec3<R> local = local_in(entrance.face, x);
      for (int i = entrance.first; i < entrance.end; ++i) {
        const Vec3<R> to = spread<R>(scene_.ways[i].image) - local;
        found = found | ((passed_[i] > R(0)) & (dot(to, to) < R(scene_.ways[i].bare2)));
      }
    }
    return found;
  }

  static constexpr bool sees_borders_far_off = false;
  static constexpr bool foresees_planes = false;

 private:
  static constexpr int halvings = 14, seeks = 4;

  /// How far a passage is from another: lengths, which change by no more than the place does, and
  /// by twice that.
  struct Margin {
    R beyond;  ///< how much longer than the influence it is
    R lead;    ///< how much shorter than that over another feature of the rim
  };
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
    R least(never), second(never), feature(0);
    for (int k = 0; k < 4; ++k) {
      const bool along_x = k % 2 == 0;
      const R half = along_x ? w : h;
      const R side = along_x ? (k == 0 ? -h : h) : (k == 1 ? w : -w);
      const R aside = (along_x ? a.y : a.x) - side;
      const BesideLine<R> ends{(along_x ? a.x : a.y) + half, sqrt(aside * aside + a.z * a.z),
                               (along_x ? b.x : b.y) + half, R(way.off[k])};
      const RimWay<R> found = over_rim(ends, half * R(2));
      const Mask better = found.length < least;
      const Mask low = found.place <= R(0), high = found.place >= half * R(2);
      // Vertices count from the lower left; the first of edge 0 is 0, its last is 1, and so on.
      const int first = k < 2 ? k : (k == 2 ? 3 : 0), last = k < 2 ? k + 1 : (k == 2 ? 2 : 3);
      const R code = select(low, R(6 + first), select(high, R(6 + last), R(2 + k)));
      // A vertex is met along two edges.
      const R longer = select(better, least, found.length);
      second = select(code == feature, second, min(second, longer));
      least = select(better, found.length, least);
      feature = select(better, code, feature);
      best.along_x = select(better, R(along_x ? 1 : 0), best.along_x);
      best.side = select(better, side, best.side);
      best.place = select(better, found.place - half, best.place);
      best.slides = select(better, select(low | high, R(0), R(1)), best.slides);
    }
    const Vec3<R> to = b - a;
    const Mask open = straight_through(face, a, b);
    const R influence(way.influence), direct = dot(to, to),
                                      length = select(open, sqrt(direct), least);
    const Mask near = (open & (direct < influence * influence)) | ((!open) & (least < influence));
    best.code = select(near, select(open, R(1), feature), R(0));
    best.margin = {length - influence, second - least};
    return best;
  }

  /// Which part of the path from a to b, as shares, lies where the image is seen through the face:
  /// before it, within the pyramid over it whose top is the image. Nothing where low >= high.
  [[nodiscard]] static LaneSpan<R> open_between(const LaneFace& face, const LaneWay& way, Vec3<R> a,
                                                Vec3<R> b) {
    const Vec3<R> image = spread<R>(way.image);
    LaneSpan<R> span{R(0), select(image.z <= R(face.tolerance), R(1), R(0))};
    const auto keep = [&](R at_a, R at_b) {
      const R zero = at_a / (at_a - at_b);
      span.low = select(at_a < R(0), select(at_b < R(0), R(2), max(span.low, zero)), span.low);
      span.high = select((at_b < R(0)) & (at_a >= R(0)), min(span.high, zero), span.high);
    };
    keep(a.z, b.z);
    const R from_a = a.z - image.z, from_b = b.z - image.z;
    const auto between = [&](R at_a, R at_b, R top, R half) {
      const R aside_a = top * a.z - image.z * at_a, aside_b = top * b.z - image.z * at_b;
      keep(half * from_a - aside_a, half * from_b - aside_b);
      keep(half * from_a + aside_a, half * from_b + aside_b);
    };
    between(a.x, b.x, image.x, R(face.half_width));
    between(a.y, b.y, image.y, R(face.half_height));
    return span;
  }

  /// Looks where a margin that is positive at two places may vanish between them: first at the
  /// bottom of the valley that it would fall into and come out of as steeply as it may.
  /// @param slope  the most that it changes by over the whole step
  /// @param at     the margin there
  template <class At>
  static void seek(Mask may, LaneSpan<R> span, R low, R high, R slope, const At& at) {
    const auto bottom = [&](R a, R b, R width) { return a + b - slope * width; };
    for (int i = 0; i < seeks; ++i) {
      const R width = span.high - span.low;
      may = may & (bottom(low, high, width) < R(0)) & (min(low, high) > R(0));
      if (!any(may)) return;
      const R u = span.low + min(max((low - high) / slope + width, R(0)) * R(0.5), width);
      const R here = at(may, u);
      // What is convex is least beside the lower of two neighbours.
      const Mask deep = here < min(low, high);
      const Mask deeper = bottom(low, here, u - span.low) < bottom(here, high, span.high - u);
      const Mask before = (deep & deeper) | ((!deep) & (low < high));
      span = {select(before, span.low, u), select(before, u, span.high)};
      low = select(before, low, here);
      high = select(before, here, high);
    }
  }

  /// Whether the segment from a to b crosses the face from front to back.
  [[nodiscard]] static Mask straight_through(const LaneFace& face, Vec3<R> a, Vec3<R> b) {
    const R above = max(a.z, R(0)), below = max(-b.z, R(0));
    const R t = select(above > R(0), above / (above + below), R(0));
    return (a.z >= R(-face.tolerance)) & (b.z <= R(face.tolerance)) &
           (abs(a.x + (b.x - a.x) * t) <= R(face.half_width)) &
           (abs(a.y + (b.y - a.y) * t) <= R(face.half_height));
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

  /// @param margins  of each way, there
  [[nodiscard]] Mask differs(Vec3<R> x, Margin* margins) const {
    Mask found = R(1) < R(0);
    for (int e = 0; e < scene_.entrance_count; ++e) {
      const LaneEntrance& entrance = scene_.entrances[e];
      const Vec3<R> local = local_in(entrance.face, x);
      for (int i = entrance.first; i < entrance.end; ++i) {
        const Passage passage = shortest(entrance.face, scene_.ways[i], local);
        found = found | !(passage.code == passed_[i]);
        margins[i] = passage.margin;
      }
    }
    return found;
  }
  [[nodiscard]] Mask differs(Vec3<R> x) const {
    Margin margins[max_lane_ways];
    return differs(x, margins);
  }

  /// What all paths add; `tell` hears of each.
  template <class Tell>
  [[nodiscard]] Vec3<R> pull(Vec3<R> x, const Tell& tell) const {
    Vec3<R> sum{R(0), R(0), R(0)};
    for (int e = 0; e < scene_.entrance_count; ++e) {
      const LaneEntrance& entrance = scene_.entrances[e];
      const Vec3<R> local = local_in(entrance.face, x);
      Vec3<R> through{R(0), R(0), R(0)};
      for (int i = entrance.first; i < entrance.end; ++i)
        through += along_way(scene_.ways[i], held_[i], local, tell);
      sum += spread<R>(entrance.face.right) * through.x + spread<R>(entrance.face.up) * through.y +
             spread<R>(entrance.face.normal) * through.z;
    }
    return sum;
  }

  /// Bends where the held feature is nearest; an edge counts as its whole line.
  template <class Tell>
  [[nodiscard]] static Vec3<R> along_way(const LaneWay& way, const Held& held, Vec3<R> a,
                                         const Tell& tell) {
    const Vec3<R> b = spread<R>(way.image);
    const Mask along_x = held.along_x > R(0), straight = held.straight > R(0);
    const R aside = select(along_x, a.y, a.x) - held.side;
    const BesideLine<R> ends{select(along_x, a.x, a.y), sqrt(aside * aside + a.z * a.z),
                             select(along_x, b.x, b.y), held.off};
    const R place = select(held.slides > R(0), ends.meeting(), held.place);
    const Vec3<R> rim{select(along_x, place, held.side), select(along_x, held.side, place), R(0)};
    const Vec3<R> bend{select(straight, b.x, rim.x), select(straight, b.y, rim.y),
                       select(straight, b.z, rim.z)};
    const Vec3<R> ahead = bend - a, rest = b - bend;
    const R near2 = dot(ahead, ahead), length = sqrt(near2) + sqrt(dot(rest, rest));
    const R square = length * length + R(way.core2);
    const R pull = way_pull(held.gm, length, square, near2);
    tell(held, square, near2);
    // Exactly on a rim there is no direction.
    return ahead * select(near2 > R(0), pull, R(0));
  }

  const LaneScene& scene_;
  R passed_[max_lane_ways];
  Margin began_[max_lane_ways];
  Held held_[max_lane_ways];
  Mask acting_;
};

}  // namespace portalens
