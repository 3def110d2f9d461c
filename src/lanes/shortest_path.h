/// \file
/// `shortest-path` over lanes, for chains of one portal.
#pragma once

#include <algorithm>
#include <utility>

#include "gravity/way_formulas.h"
#include "lanes/border.h"
#include "lanes/face_axes.h"
#include "lanes/first_meeting.h"
#include "lanes/path.h"
#include "lanes/pull.h"
#include "lanes/rim.h"
#include "lanes/scene.h"

namespace portalens {

/// @tparam Rim  of the portals: `LaneRim`, of rectangles, or `LaneOutlineRim`
template <class R, class Rim>
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
        const Passage passage = Rim::shortest(entrance.face, scene_.ways[i], local);
        passed_[i] = passage.code;
        began_[i] = passage.margin;
        acting_ = acting_ | (passage.code > R(0));
        Rim::freeze(scene_.ways[i], passage, held_[i]);
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
      add_gradient(sum, select(acts, R(2) * held.gm * inverse_square * sqrt(inverse2), R(0)));
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
            return Rim::shortest(entrance.face, scene_.ways[i],
                                 local_in(entrance.face, path.place.at(u)));
          };
          const auto tell = [&](Mask where, R u) { found = select(where, min(found, u), found); };
          const Margin &a = before[i], &b = after[i];
          const Mask out = !(passed_[i] > R(0));
          seek_margin(still & out, span, a.beyond, b.beyond, path.h, [&](Mask may, R u) {
            const Passage passage = passage_at(u);
            tell(may & (passage.code > R(0)), u);
            return passage.margin.beyond;
          });
          seek_margin(still & (passed_[i] > R(1)), span, a.lead, b.lead, R(2) * path.h,
                      [&](Mask may, R u) {
                        const Passage passage = passage_at(u);
                        const Mask other = may & !(passage.code == passed_[i]);
                        tell(other, u);
                        return select(other, R(0), passage.margin.lead);
                      });
          const LaneSpan<R> open = Rim::open_between(entrance.face, scene_.ways[i], from, to);
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
  using Margin = typename Rim::Margin;
  using Passage = typename Rim::Passage;
  using Held = typename Rim::Held;

  static constexpr int halvings = 14;

  /// @param margins  of each way, there
  [[nodiscard]] Mask differs(Vec3<R> x, Margin* margins) const {
    Mask found = R(1) < R(0);
    for (int e = 0; e < scene_.entrance_count; ++e) {
      const LaneEntrance& entrance = scene_.entrances[e];
      const Vec3<R> local = local_in(entrance.face, x);
      for (int i = entrance.first; i < entrance.end; ++i) {
        const Passage passage = Rim::shortest(entrance.face, scene_.ways[i], local);
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
    const Mask straight = held.straight > R(0);
    const Vec3<R> rim = Rim::bend(held, a, b);
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
