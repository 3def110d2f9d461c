/// \file
/// Over lanes: what is decided about gates at a step's start, and places and paths as each gate
/// sees them. What is decided stays frozen over the step, as in `Field`.
#pragma once

#include "lanes/face_axes.h"
#include "lanes/path.h"
#include "lanes/scene.h"

namespace portalens {

/// Whether the nearest point of a polynomial path has a polynomial path itself: then gates may have
/// children.
template <class Nearest, class R>
concept LeadsOn = requires(const Nearest& nearest, const LocalPath<R>& path) {
  nearest.led_by(path);
};

/// The decisions of one step.
/// @tparam Nearest  the nearest feature of a portal: `LaneNearest` (of a rectangle),
///                  `LaneOutlineNearest`, `LaneSimpleNearest`, or `LaneAnyNearest`
template <class R, class Nearest>
class LaneGateDecisions {
 public:
  using Mask = typename R::Mask;

  explicit LaneGateDecisions(const LaneScene& the_scene)
      : scene_(the_scene), acting_(R(1) < R(0)) {}

  /// Everything, for a step from there.
  void decide(Vec3<R> anchor) {
    acting_ = R(1) < R(0);
    R qx[max_lane_gates], qy[max_lane_gates];
    for (int g = 0; g < scene_.gate_count; ++g) {
      const LaneGate& gate = scene_.gates[g];
      const Vec3<R> local = local_of(g, anchor, qx, qy);
      const R above = gate.parent < 0 ? R(1) : reached_[gate.parent];
      anchor_x_[g] = local.x;
      anchor_y_[g] = local.y;
      anchor_z_[g] = local.z;
      nearest_[g] = Nearest::on(gate, local);
      const Vec3<R> q = nearest_[g].place(local), from = local - q;
      qx[g] = q.x;
      qy[g] = q.y;
      apart2_[g] = dot(from, from);
      const auto near = (apart2_[g] < R(gate.reach2)) & (above > R(0));
      reached_[g] = select(near, R(1), R(0));
      acting_ = acting_ | near;
      for (int i = 0; i < scene_.mass_count; ++i) {
        const Vec3<R> d = spread<R>(gate.images[i]) - q;
        seen_[g][i] = select(near & (dot(d, d) < R(scene_.masses[i].influence2)),
                             R(scene_.masses[i].gm), R(0));
      }
    }
  }

  [[nodiscard]] Mask acting() const { return acting_; }

 protected:
  [[nodiscard]] Vec3<R> local_of(int g, Vec3<R> x, const R* qx, const R* qy) const {
    const LaneGate& gate = scene_.gates[g];
    if (gate.parent < 0)
      return to_axes(x - spread<R>(gate.origin), gate.right, gate.up, gate.normal);
    return multiply_add(
        spread<R>(gate.by_y), qy[gate.parent],
        multiply_add(spread<R>(gate.by_x), qx[gate.parent], spread<R>(gate.offset)));
  }

  /// A gate's own direction of the path `t`: through another gate that of its nearest point.
  [[nodiscard]] Vec3<R> way_of(int g, Vec3<R> t, const R* speed_x, const R* speed_y) const {
    const LaneGate& gate = scene_.gates[g];
    if (gate.parent < 0) return to_axes(t, gate.right, gate.up, gate.normal);
    return spread<R>(gate.by_x) * speed_x[gate.parent] +
           spread<R>(gate.by_y) * speed_y[gate.parent];
  }

  /// By how much the coordinates in a gate's axes sway: through another gate those of its nearest
  /// point, which may stand still.
  [[nodiscard]] Vec3<R> sway_of(int g, R sway, const R* sway_x, const R* sway_y) const {
    const LaneGate& gate = scene_.gates[g];
    if (gate.parent < 0) return {sway, sway, sway};
    const auto positive = [](LaneVec v) {
      return spread<R>({v.x < 0 ? -v.x : v.x, v.y < 0 ? -v.y : v.y, v.z < 0 ? -v.z : v.z});
    };
    return positive(gate.by_x) * sway_x[gate.parent] + positive(gate.by_y) * sway_y[gate.parent];
  }

  /// The path in a gate's coordinates; through another gate that of its nearest point.
  [[nodiscard]] LocalPath<R> seen_from(int g, const LanePath<R>& path) const {
    const LaneGate& gate = scene_.gates[g];
    if constexpr (LeadsOn<Nearest, R>) {
      if (gate.parent >= 0) {
        const LocalPath<R> q = nearest_[gate.parent].led_by(seen_from(gate.parent, path));
        return {q.x * R(gate.by_x.x) + q.y * R(gate.by_y.x) + R(gate.offset.x),
                q.x * R(gate.by_x.y) + q.y * R(gate.by_y.y) + R(gate.offset.y),
                q.x * R(gate.by_x.z) + q.y * R(gate.by_y.z) + R(gate.offset.z)};
      }
    }
    return LocalPath<R>::over(gate, path);
  }

  const LaneScene& scene_;
  Mask acting_;
  Nearest nearest_[max_lane_gates];
  /// For which place that was decided, in the gate's coordinates.
  R anchor_x_[max_lane_gates], anchor_y_[max_lane_gates], anchor_z_[max_lane_gates];
  R apart2_[max_lane_gates];                 ///< square of its distance from the nearest point
  R reached_[max_lane_gates];                ///< 1 where the gate acts
  R seen_[max_lane_gates][max_lane_masses];  ///< G M / c² where a mass acts through it, else 0
};

}  // namespace portalens
