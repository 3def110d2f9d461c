/// \file
/// Over lanes: what `closest-point` brings through portals.
#pragma once

#include "lanes/border.h"
#include "lanes/face_axes.h"
#include "lanes/gate_changes.h"
#include "lanes/pull.h"
#include "lanes/rectangle.h"
#include "lanes/scene.h"

namespace portalens {

/// What comes through the gates of a scene, for one step.
template <class R, class Nearest>
class LaneGates : public LaneGateChanges<R, Nearest> {
 public:
  using Base = LaneGateChanges<R, Nearest>;
  using Base::Base;
  using typename Base::Mask;

  /// What comes through the gates depends on where the points of their faces are, not on where
  /// the photon is: steps are the longer the slower those move.
  void add_to(BendingOf<R>& sum, Vec3<R> x, Vec3<R> t) const {
    R speed_x[max_lane_gates], speed_y[max_lane_gates], slowness[max_lane_gates];
    [[maybe_unused]] R swings[max_lane_gates];
    for (int g = 0; g < scene_.gate_count; ++g) {
      const Vec3<R> way = way_of(g, t, speed_x, speed_y);
      speed_x[g] = nearest_[g].speed_x(way);
      speed_y[g] = nearest_[g].speed_y(way);
      slowness[g] = slowness_of(speed_x[g], speed_y[g]);
      if constexpr (!LeadsOn<Nearest, R>)
        swings[g] = R(2.0 * swing_weight * distant_weight) * nearest_[g].swings() *
                    nearest_[g].moves() * slowness_of(way.x, way.y);
    }
    sum.acceleration += through_gates(x, [&](int g, const Source& source, R gm) {
      const R inverse4 = source.inverse2 * source.inverse2;
      sum.stiffness = multiply_add(source.pull * source.inverse2, R(distant_weight) * slowness[g],
                                   sum.stiffness);
      if constexpr (!LeadsOn<Nearest, R>)
        sum.stiffness = multiply_add(source.pull, swings[g], sum.stiffness);
      sum.nearness =
          select(gm > R(0), multiply_add(inverse4, slowness[g], sum.nearness), sum.nearness);
      add_gradient(sum, R(2) * source.pull * nearest_[g].moves());
    });
  }

  [[nodiscard]] Vec3<R> acceleration(Vec3<R> x) const {
    return through_gates(x, [](int, const Source&, R) {});
  }

  /// As of `LaneMasses`.
  /// @param acting  where something acts, be it not through a gate
  [[nodiscard]] LaneBorder<R> boundary(Vec3<R> x, Vec3<R> t, Vec3<R> bend, Mask acting, R) const {
    LaneBorder<R> first;
    for (int g = 0; g < scene_.gate_count; ++g) {
      const LaneGate& gate = scene_.gates[g];
      if (gate.parent >= 0) continue;
      const Vec3<R> local = to_axes(x - spread<R>(gate.origin), gate.right, gate.up, gate.normal);
      const Vec3<R> way = to_axes(t, gate.right, gate.up, gate.normal);
      const Vec3<R> turn = to_axes(bend, gate.right, gate.up, gate.normal);
      LaneBorder<R> own = until_other_nearest(gate, nearest_[g], (reached_[g] > R(0)) | (!acting),
                                              local, way, turn);
      // Where nothing acts, no border matters before the path comes near.
      if (any(!acting))
        own.at = select(acting, own.at, max(own.at, until_ball(R(gate.ball), local, way)));
      own.normal = to_world(gate, own.normal);
      first.offer(own);
    }
    if (scene_.fading) first.offer(until_faded(x, t));
    return first;
  }

  /// Where a mass seen through a gate is so near that floats can't follow the light: `bare2`; or
  /// the nearest point of a gate turns too fast.
  [[nodiscard]] Mask too_near(Vec3<R> x) const {
    Mask found = R(1) < R(0);
    if constexpr (!LeadsOn<Nearest, R>)
      for (int g = 0; g < scene_.gate_count; ++g)
        found = found | ((reached_[g] > R(0)) & runs_round(nearest_[g]));
    if (!scene_.bare_through) return found;
    R qx[max_lane_gates], qy[max_lane_gates];
    for (int g = 0; g < scene_.gate_count; ++g) {
      const Vec3<R> local = local_of(g, x, qx, qy);
      const Vec3<R> q = nearest_[g].place(local);
      qx[g] = q.x;
      qy[g] = q.y;
      for (int i = 0; i < scene_.mass_count; ++i) {
        const Vec3<R> d = spread<R>(scene_.gates[g].images[i]) - q;
        found = found | ((reached_[g] > R(0)) & (dot(d, d) < R(scene_.gates[g].bare2[i])));
      }
    }
    return found;
  }

  static constexpr bool sees_borders_far_off = true;
  static constexpr bool foresees_planes = true;

 private:
  using Source = MassPull<R>;
  using Base::local_of;
  using Base::nearest_;
  using Base::reached_;
  using Base::scene_;
  using Base::seen_;
  using Base::way_of;

  /// Where on a straight path a mass begins or ceases to act through a gate, or a gate with a
  /// parent.
  [[nodiscard]] R until_faded(Vec3<R> x, Vec3<R> t) const {
    R least(never);
    R qx[max_lane_gates], qy[max_lane_gates], vx[max_lane_gates], vy[max_lane_gates];
    for (int g = 0; g < scene_.gate_count; ++g) {
      const LaneGate& gate = scene_.gates[g];
      const Vec3<R> local = local_of(g, x, qx, qy), way = way_of(g, t, vx, vy);
      const Vec3<R> q = nearest_[g].place(local);
      qx[g] = q.x;
      qy[g] = q.y;
      vx[g] = nearest_[g].speed_x(way);
      vy[g] = nearest_[g].speed_y(way);
      const auto acts = reached_[g] > R(0);
      if (gate.falls_short) {
        const Vec3<R> from = local - q;
        const Vec3<R> rate{way.x - vx[g], way.y - vy[g], way.z};
        const R ends =
            until_sphere(acts, -dot(from, rate), dot(from, from) - R(gate.reach2), dot(rate, rate));
        least = min(least, select(reached_[gate.parent] > R(0), ends, R(never)));
      }
      const R speed2 = multiply_add(vx[g], vx[g], vy[g] * vy[g]);
      for (int i = 0; i < scene_.mass_count; ++i) {
        if (!gate.fades[i]) continue;
        const Vec3<R> d = spread<R>(gate.images[i]) - q;
        const R ends = until_sphere(seen_[g][i] > R(0), multiply_add(d.x, vx[g], d.y * vy[g]),
                                    dot(d, d) - R(scene_.masses[i].influence2), speed2);
        least = min(least, select(acts, ends, R(never)));
      }
    }
    return least;
  }

  /// What comes through the gates; `tell` hears of every mass seen through one.
  template <class Tell>
  [[nodiscard]] Vec3<R> through_gates(Vec3<R> x, const Tell& tell) const {
    R qx[max_lane_gates], qy[max_lane_gates];
    R ax[max_lane_gates], ay[max_lane_gates], az[max_lane_gates];
    for (int g = 0; g < scene_.gate_count; ++g) {
      const Vec3<R> local = local_of(g, x, qx, qy);
      const Vec3<R> q = nearest_[g].place(local);
      qx[g] = q.x;
      qy[g] = q.y;
      ax[g] = ay[g] = az[g] = R(0);
      for (int i = 0; i < scene_.mass_count; ++i) {
        const Vec3<R> to_mass = spread<R>(scene_.gates[g].images[i]) - q;
        const Source source =
            Source::of(dot(to_mass, to_mass) + R(scene_.masses[i].core2), seen_[g][i]);
        ax[g] = multiply_add(to_mass.x, source.pull, ax[g]);
        ay[g] = multiply_add(to_mass.y, source.pull, ay[g]);
        az[g] = multiply_add(to_mass.z, source.pull, az[g]);
        tell(g, source, seen_[g][i]);
      }
    }
    // Children stand behind their parents.
    Vec3<R> sum{R(0), R(0), R(0)};
    for (int g = scene_.gate_count - 1; g >= 0; --g) {
      const LaneGate& gate = scene_.gates[g];
      if (gate.parent < 0) {
        sum = multiply_add(spread<R>(gate.right), ax[g], sum);
        sum = multiply_add(spread<R>(gate.up), ay[g], sum);
        sum = multiply_add(spread<R>(gate.normal), az[g], sum);
        continue;
      }
      Vec3<R> turned{ax[gate.parent], ay[gate.parent], az[gate.parent]};
      turned = multiply_add(spread<R>(gate.to_parent_x), ax[g], turned);
      turned = multiply_add(spread<R>(gate.to_parent_y), ay[g], turned);
      turned = multiply_add(spread<R>(gate.to_parent_z), az[g], turned);
      ax[gate.parent] = turned.x;
      ay[gate.parent] = turned.y;
      az[gate.parent] = turned.z;
    }
    return sum;
  }
};

}  // namespace portalens
