/// \file
/// The field over lanes: masses directly, and `closest-point` through rectangular portals. What
/// is decided at a step's start stays frozen over it, as in `Field`.
#pragma once

#include "gravity/attraction.h"
#include "math/vec3.h"
#include "photon/lane_rectangle.h"
#include "photon/lane_scene.h"

namespace portalens {

template <class R>
struct LaneBending {
  Vec3<R> acceleration;
  R stiffness, nearness;
};

/// The decisions of one step.
template <class R>
struct LaneField {
  const LaneScene& scene;
  R inside[most_lane_masses];  ///< G M / c² where the influence holds, else 0
  LaneFoot<R> feet[most_lane_gates];
  R seen[most_lane_gates][most_lane_masses];  ///< as `inside`, through the gate
  typename R::Mask acting;

  explicit LaneField(const LaneScene& the_scene) : scene(the_scene), acting(R(1) < R(0)) {}

  /// Decides everything at `anchor`.
  void decide(Vec3<R> anchor) {
    acting = R(1) < R(0);
    for (int i = 0; i < scene.mass_count; ++i) {
      const LaneMass& mass = scene.masses[i];
      const Vec3<R> d = spread<R>(mass.center) - anchor;
      const auto within = dot(d, d) < R(mass.influence2);
      inside[i] = select(within, R(mass.gm), R(0));
      acting = acting | within;
    }
    R qx[most_lane_gates], qy[most_lane_gates], reached[most_lane_gates];
    for (int g = 0; g < scene.gate_count; ++g) {
      const LaneGate& gate = scene.gates[g];
      const Vec3<R> local = local_of(g, anchor, qx, qy);
      const R above = gate.parent < 0 ? R(1) : reached[gate.parent];
      feet[g] = foot_on(gate, local);
      qx[g] = feet[g].x(local);
      qy[g] = feet[g].y(local);
      const R dx = local.x - qx[g], dy = local.y - qy[g];
      const auto near = (dx * dx + dy * dy + local.z * local.z < R(gate.reach2)) & (above > R(0));
      reached[g] = select(near, R(1), R(0));
      acting = acting | near;
      for (int i = 0; i < scene.mass_count; ++i) {
        const Vec3<R> d = spread<R>(gate.images[i]) - Vec3<R>{qx[g], qy[g], R(0)};
        seen[g][i] =
            select(near & (dot(d, d) < R(scene.masses[i].influence2)), R(scene.masses[i].gm), R(0));
      }
    }
  }

  /// What a step of the direction `t` is chosen from, and its first acceleration.
  [[nodiscard]] LaneBending<R> bending(Vec3<R> x, Vec3<R> t) const {
    LaneBending<R> sum{{R(0), R(0), R(0)}, R(0), R(0)};
    for (int i = 0; i < scene.mass_count; ++i) {
      const Vec3<R> to_mass = spread<R>(scene.masses[i].center) - x;
      const R along = dot(to_mass, t);
      const R b2 = dot(to_mass, to_mass) + R(scene.masses[i].core2) - along * along;
      const R m2 = R(scene.masses[i].gm * scene.masses[i].gm);
      const Source source = pull_of(to_mass, inside[i], R(scene.masses[i].core2));
      sum.acceleration += to_mass * source.pull;
      add(sum, source, inside[i], path_weight(m2, max(b2, R(0))));
    }
    if (scene.gate_count > 0)
      sum.acceleration += through_gates(
          x, [&](const Source& source, R gm) { add(sum, source, gm, R(distant_weight)); });
    return sum;
  }

  [[nodiscard]] Vec3<R> acceleration(Vec3<R> x) const {
    Vec3<R> sum{R(0), R(0), R(0)};
    for (int i = 0; i < scene.mass_count; ++i) {
      const Vec3<R> to_mass = spread<R>(scene.masses[i].center) - x;
      sum += to_mass * pull_of(to_mass, inside[i], R(scene.masses[i].core2)).pull;
    }
    if (scene.gate_count > 0) sum += through_gates(x, [](const Source&, R) {});
    return sum;
  }

  /// Arc length along the parabola x + t s + bend s²/2 to the next place where a decision changes;
  /// changes beyond a limit, the last argument, need not be found.
  [[nodiscard]] R boundary(Vec3<R> x, Vec3<R> t, Vec3<R> bend, R) const {
    const R never(scene.farthest);
    R least = never;
    for (int i = 0; i < scene.mass_count; ++i) {
      const LaneMass& mass = scene.masses[i];
      least =
          min(least, until_shell(x - spread<R>(mass.center), t, bend, R(mass.influence2), never));
    }
    for (int g = 0; g < scene.gate_count; ++g) {
      const LaneGate& gate = scene.gates[g];
      if (gate.parent >= 0) continue;
      const Vec3<R> local = to_axes(x - spread<R>(gate.origin), gate.right, gate.up, gate.normal);
      const Vec3<R> way = to_axes(t, gate.right, gate.up, gate.normal);
      least = min(least, until_other_foot(gate, feet[g], local, way, never));
    }
    return least;
  }

 private:
  struct Source {
    R inverse2, pull;  ///< 1/d² and m/d³
  };

  [[nodiscard]] static Source pull_of(Vec3<R> to_mass, R gm, R core2) {
    const R inverse2 = R(1) / (dot(to_mass, to_mass) + core2);
    return {inverse2, gm * inverse2 * sqrt(inverse2)};
  }

  static void add(LaneBending<R>& sum, const Source& source, R gm, R weight) {
    sum.stiffness = sum.stiffness + source.pull * source.inverse2 * weight;
    sum.nearness = sum.nearness + select(gm > R(0), source.inverse2 * source.inverse2, R(0));
  }

  /// What comes through the gates; `tell` hears of every mass seen through one.
  template <class Tell>
  [[nodiscard]] Vec3<R> through_gates(Vec3<R> x, const Tell& tell) const {
    R qx[most_lane_gates], qy[most_lane_gates];
    R ax[most_lane_gates], ay[most_lane_gates], az[most_lane_gates];
    for (int g = 0; g < scene.gate_count; ++g) {
      const Vec3<R> local = local_of(g, x, qx, qy);
      qx[g] = feet[g].x(local);
      qy[g] = feet[g].y(local);
      ax[g] = ay[g] = az[g] = R(0);
      for (int i = 0; i < scene.mass_count; ++i) {
        const Vec3<R> to_mass = spread<R>(scene.gates[g].images[i]) - Vec3<R>{qx[g], qy[g], R(0)};
        const Source source = pull_of(to_mass, seen[g][i], R(scene.masses[i].core2));
        ax[g] = ax[g] + to_mass.x * source.pull;
        ay[g] = ay[g] + to_mass.y * source.pull;
        az[g] = az[g] + to_mass.z * source.pull;
        tell(source, seen[g][i]);
      }
    }
    // Children stand behind their parents.
    Vec3<R> sum{R(0), R(0), R(0)};
    for (int g = scene.gate_count - 1; g >= 0; --g) {
      const LaneGate& gate = scene.gates[g];
      if (gate.parent < 0) {
        sum += spread<R>(gate.right) * ax[g] + spread<R>(gate.up) * ay[g] +
               spread<R>(gate.normal) * az[g];
        continue;
      }
      const Vec3<R> turned = spread<R>(gate.to_parent_x) * ax[g] +
                             spread<R>(gate.to_parent_y) * ay[g] +
                             spread<R>(gate.to_parent_z) * az[g];
      ax[gate.parent] = ax[gate.parent] + turned.x;
      ay[gate.parent] = ay[gate.parent] + turned.y;
      az[gate.parent] = az[gate.parent] + turned.z;
    }
    return sum;
  }

  [[nodiscard]] Vec3<R> local_of(int g, Vec3<R> x, const R* qx, const R* qy) const {
    const LaneGate& gate = scene.gates[g];
    if (gate.parent < 0)
      return to_axes(x - spread<R>(gate.origin), gate.right, gate.up, gate.normal);
    return spread<R>(gate.offset) + spread<R>(gate.by_x) * qx[gate.parent] +
           spread<R>(gate.by_y) * qy[gate.parent];
  }
};

}  // namespace portalens
