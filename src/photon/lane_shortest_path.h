/// \file
/// `shortest-path` over lanes, for chains of one rectangular portal.
#pragma once

#include "gravity/way_formulas.h"
#include "photon/lane_field.h"
#include "photon/lane_rectangle.h"

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
        acting_ = acting_ | (passage.code > R(0));
        freeze(scene_.ways[i], passage, held_[i]);
      }
    }
  }
  [[nodiscard]] Mask acting() const { return acting_; }

  void add_to(LaneBending<R>& sum, Vec3<R> x, Vec3<R>) const {
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

  /// Looked for at quarters of the step, then by halving: where ways change has no closed form.
  [[nodiscard]] R boundary(Vec3<R> x, Vec3<R> t, Vec3<R> bend, R limit) const {
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
    if (!any(changed)) return R(never);
    for (int k = 0; k < halvings; ++k) {
      const R middle = (good + bad) * R(0.5);
      const Mask now = differs(at(middle));
      bad = select(now, middle, bad);
      good = select(now, good, middle);
    }
    return select(changed, bad, R(never));
  }

  /// As in `LaneField`: by halving, as `boundary`.
  void find_changes(FirstMeeting<R>& first, Mask which, const LanePath<R>& path, R over) const {
    const LaneLooks<R> looks(path, over);
    R good(0), bad(2);
    Mask changed = R(1) < R(0);
    for (int k = 1; k < LaneLooks<R>::count; ++k) {
      const Mask now = which & !changed & differs(looks.place[k]);
      bad = select(now, looks.share[k], bad);
      changed = changed | now;
      good = select(changed, good, looks.share[k]);
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

  /// As of `LaneField`; ways over the rim are longer than straight ones.
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

 private:
  static constexpr int halvings = 10;

  /// How a way passes the rim: over the edge along x or y on the line at `side`, or over a vertex.
  struct Passage {
    R code;  ///< 0: out of reach, 1: straight, else one number for each feature
    R along_x, side, place;
    R slides;  ///< 1 inside of the edge, 0 at a vertex
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
    Passage best{R(0), R(1), R(0), R(0), R(0)};
    R least(way.influence);
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
      least = select(better, found.length, least);
      best.code = select(better, code, best.code);
      best.along_x = select(better, R(along_x ? 1 : 0), best.along_x);
      best.side = select(better, side, best.side);
      best.place = select(better, found.place - half, best.place);
      best.slides = select(better, select(low | high, R(0), R(1)), best.slides);
    }
    const Vec3<R> to = b - a;
    const Mask open = straight_through(face, a, b);
    const Mask near = dot(to, to) < R(way.influence) * R(way.influence);
    best.code = select(open, select(near, R(1), R(0)), best.code);
    return best;
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

  [[nodiscard]] Mask differs(Vec3<R> x) const {
    Mask found = R(1) < R(0);
    for (int e = 0; e < scene_.entrance_count; ++e) {
      const LaneEntrance& entrance = scene_.entrances[e];
      const Vec3<R> local = local_in(entrance.face, x);
      for (int i = entrance.first; i < entrance.end; ++i)
        found = found | !(shortest(entrance.face, scene_.ways[i], local).code == passed_[i]);
    }
    return found;
  }

  /// What all ways add; `tell` hears of each.
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
  R passed_[most_lane_ways];
  Held held_[most_lane_ways];
  Mask acting_;
};

}  // namespace portalens
