/// \file
/// Over lanes: where on a step's path changes what was decided about gates at its start.
#pragma once

#include "lanes/any_face.h"
#include "lanes/face_axes.h"
#include "lanes/first_meeting.h"
#include "lanes/gate_decisions.h"
#include "lanes/path.h"
#include "lanes/scene.h"

namespace portalens {

/// The decisions of one step, and where they cease to hold.
template <class R, class Nearest>
class LaneGateChanges : public LaneGateDecisions<R, Nearest> {
 public:
  using Base = LaneGateDecisions<R, Nearest>;
  using Base::Base;
  using typename Base::Mask;

  /// As of `LaneMasses`.
  void find_changes(FirstMeeting<R>& first, Mask which, const LanePath<R>& path, R over) const {
    const Vec3<R> end = path.place.at(last_look(path, over));
    Mask may[max_lane_gates];
    if (may_change_gates(may, which, path, end)) find_gates(first, may, path, over);
  }

 protected:
  using Base::anchor_x_;
  using Base::anchor_y_;
  using Base::anchor_z_;
  using Base::apart2_;
  using Base::local_of;
  using Base::nearest_;
  using Base::reached_;
  using Base::scene_;
  using Base::seen_;
  using Base::seen_from;
  using Base::sway_of;

 private:
  /// Sets `may[g]` to the lanes in which something that was decided about gate g may cease to hold
  /// along the path.
  /// @param end  where the path ends, nearly
  /// @return whether there is such a lane
  [[nodiscard]] bool may_change_gates(Mask* may, Mask which, const LanePath<R>& path,
                                      Vec3<R> end) const {
    R qx[max_lane_gates], qy[max_lane_gates], sway_x[max_lane_gates], sway_y[max_lane_gates];
    auto some = R(1) < R(0);
    for (int g = 0; g < scene_.gate_count; ++g) {
      const LaneGate& gate = scene_.gates[g];
      const Vec3<R> start{anchor_x_[g], anchor_y_[g], anchor_z_[g]};
      const Vec3<R> local = local_of(g, end, qx, qy);
      const Vec3<R> q0 = nearest_[g].place(start), q = nearest_[g].place(local);
      qx[g] = q.x;
      qy[g] = q.y;
      const auto acts = reached_[g] > R(0);
      auto keeps = !which;
      if (gate.parent >= 0) keeps = keeps | !(reached_[gate.parent] > R(0));
      if (gate.parent < 0 || gate.falls_short) {
        const Vec3<R> from = local - q;
        const R square = dot(from, from), inner = max(R(gate.reach) - path.sway, R(0));
        keeps = keeps | (acts & stays_within(g, square, inner, path));
        const auto waits = !(acts | keeps);
        if (any(waits)) keeps = keeps | (waits & stays_out_of(g, start, local, path));
      } else {
        keeps = R(0) < R(1);
      }
      const Vec3<R> sway = sway_of(g, path.sway, sway_x, sway_y);
      if constexpr (LeadsOn<Nearest, R>) {
        sway_x[g] = nearest_[g].sway_x(sway);
        sway_y[g] = nearest_[g].sway_y(sway);
      }
      if (any(acts)) keeps = keeps & (keeps_nearest(gate, nearest_[g], start, local, sway) | !acts);
      for (int i = 0; i < scene_.mass_count; ++i)
        if (gate.fades[i] && any(acts)) {
          const Vec3<R> image = spread<R>(gate.images[i]);
          keeps = keeps & (keeps_fading(g, i, q0 - image, q - image, path) | !acts);
        }
      may[g] = which & !keeps;
      some = some | may[g];
    }
    return any(some);
  }

  /// True only where a path that begins in reach of a gate stays so.
  /// @param square  of the distance at its end
  /// @param inner   the reach, less what the path may stray from its chord
  [[nodiscard]] Mask stays_within(int g, R square, R inner, const LanePath<R>& path) const {
    const R most = max(apart2_[g], square), least = min(apart2_[g], square);
    if constexpr (LeadsOn<Nearest, R>) {
      return (square <= R(scene_.gates[g].reach2)) & (least <= inner * inner);
    } else {  // right behind a face the distance from its rim is not convex
      const R closer = max(inner - path.h, R(0));
      return most <= closer * closer;
    }
  }

  /// True only where a mass goes on to act through a gate, or not to act.
  /// @param first, last  from its image to the nearest point, at both ends
  [[nodiscard]] Mask keeps_fading(int g, int i, Vec3<R> first, Vec3<R> last,
                                  const LanePath<R>& path) const {
    const R influence(scene_.masses[i].influence);
    if constexpr (LeadsOn<Nearest, R>)
      return keeps_its_side(seen_[g][i] > R(0), first, last, influence, path);
    else
      return abs(sqrt(dot(first, first)) - influence) > path.h * nearest_[g].fastest(path.h);
  }

  /// True only where a path stays out of reach of a gate.
  [[nodiscard]] Mask stays_out_of(int g, Vec3<R> start, Vec3<R> end,
                                  const LanePath<R>& path) const {
    const LaneGate& gate = scene_.gates[g];
    const Nearest last = Nearest::on(gate, end);
    const Vec3<R> q0 = nearest_[g].place(start), q1 = last.place(end);
    // Past the plane the face is at once as near as that.
    const auto behind = is_behind(gate, nearest_[g], start) | is_behind(gate, last, end);
    const auto below = (start.z < R(0)) & keeps_margin(-start.z, -end.z, path.sway);
    return stays_beyond(R(gate.reach), start - q0, end - q1, end - start, path, !behind) &
           (below | !behind);
  }

  /// Where the nearest point of a gate that acts changes its feature, or where something begins or
  /// ceases to act through one.
  /// @param may  of each gate, the lanes where that may be
  [[gnu::noinline]] void find_gates(FirstMeeting<R>& first, const Mask* may,
                                    const LanePath<R>& path, R over) const {
    bool asked[max_lane_gates], follows[max_lane_gates] = {};
    // Children stand behind their parents.
    for (int g = scene_.gate_count - 1; g >= 0; --g) {
      asked[g] = any(may[g]);
      follows[g] = follows[g] || asked[g];
      if (follows[g] && scene_.gates[g].parent >= 0) follows[scene_.gates[g].parent] = true;
    }
    const LaneLooks<R> looks(path, over);
    const R gap = path.h * R(1.0 / (LaneLooks<R>::count - 1));
    R qx[max_lane_gates], qy[max_lane_gates], apart[max_lane_gates];
    R faded[max_lane_gates][max_lane_masses];
    for (int k = 0; k < LaneLooks<R>::count; ++k)
      for (int g = 0; g < scene_.gate_count; ++g) {
        if (!follows[g]) continue;
        const LaneGate& gate = scene_.gates[g];
        const Vec3<R> local = local_of(g, looks.place[k], qx, qy);
        Nearest nearest_point = nearest_[g];
        const auto acts = reached_[g] > R(0), other = has_other_nearest(gate, nearest_point, local);
        if (any(other & !acts)) nearest_point.take(other & !acts, Nearest::on(gate, local));
        const Vec3<R> q = nearest_point.place(local), from = local - q;
        qx[g] = q.x;
        qy[g] = q.y;
        if (!asked[g]) continue;
        const LaneSpan<R> reaches{k > 0 ? apart[g] : R(0), dot(from, from)};
        apart[g] = reaches.high;
        const LaneSpan<R> span = looks.before(k > 0 ? k : 1);
        const auto still = may[g] & first.open(span);
        const bool looks_at = k > 0 && any(still);
        if (looks_at) {
          const auto changed = still & acts & other;
          if (any(changed))
            offer_borders(first, gate, nearest_[g], changed, seen_from(g, path), span);
          if (gate.parent < 0 || gate.falls_short)
            first.offer_ball(still, acts, R(gate.reach), reaches, gap, span, [&] {
              return LaneApart<R, LaneGate, Nearest>{gate, seen_from(g, path), nearest_[g], acts};
            });
        }
        for (int i = 0; i < scene_.mass_count; ++i) {
          if (!gate.fades[i]) continue;
          const Vec3<R> to_mass = spread<R>(gate.images[i]) - q;
          const LaneSpan<R> to_masses{k > 0 ? faded[g][i] : R(0), dot(to_mass, to_mass)};
          faded[g][i] = to_masses.high;
          R its_gap = gap;
          if constexpr (!LeadsOn<Nearest, R>) its_gap = gap * nearest_[g].fastest(path.h);
          if (looks_at)
            first.offer_ball(still & acts, seen_[g][i] > R(0), R(scene_.masses[i].influence),
                             to_masses, its_gap, span, [&] { return faded_on(g, i, path); });
        }
      }
  }

  /// How far a mass is, on a path, from the nearest point of a gate that it acts through.
  [[nodiscard]] auto faded_on(int g, int i, const LanePath<R>& path) const {
    const LaneVec& image = scene_.gates[g].images[i];
    const R influence2(scene_.masses[i].influence2);
    if constexpr (LeadsOn<Nearest, R>) {
      const LocalPath<R> q = nearest_[g].led_by(seen_from(g, path));
      return LaneSquare<R>{q.x + R(-image.x),
                           q.y + R(-image.y),
                           {R(image.z), R(0), R(0), R(0), R(0), R(0)},
                           influence2};
    } else {
      return LaneAnyFading<R>{{nearest_[g], seen_from(g, path)}, spread<R>(image), influence2};
    }
  }
};

}  // namespace portalens
