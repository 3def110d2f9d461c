/// \file
/// Over lanes: what `closest-point` brings through portals. What is decided at a step's start stays
/// frozen over it, as in `Field`.
#pragma once

#include "lanes/pull.h"
#include "lanes/scene.h"

namespace portalens {

/// The decisions of one step.
/// @tparam Nearest  the nearest feature of a portal: of a rectangle, or `LaneOutlineNearest`
template <class R, class Nearest>
class LaneGates {
 public:
  using Mask = typename R::Mask;

  explicit LaneGates(const LaneScene& the_scene) : scene_(the_scene), acting_(R(1) < R(0)) {}

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
      qx[g] = nearest_[g].x(local);
      qy[g] = nearest_[g].y(local);
      const Vec3<R> from{local.x - qx[g], local.y - qy[g], local.z};
      apart2_[g] = dot(from, from);
      const auto near = (apart2_[g] < R(gate.reach2)) & (above > R(0));
      reached_[g] = select(near, R(1), R(0));
      acting_ = acting_ | near;
      for (int i = 0; i < scene_.mass_count; ++i) {
        const Vec3<R> d = spread<R>(gate.images[i]) - Vec3<R>{qx[g], qy[g], R(0)};
        seen_[g][i] = select(near & (dot(d, d) < R(scene_.masses[i].influence2)),
                             R(scene_.masses[i].gm), R(0));
      }
    }
  }

  [[nodiscard]] Mask acting() const { return acting_; }

  /// What comes through the gates depends on where the points of their faces are, not on where
  /// the photon is: steps are the longer the slower those move.
  void add_to(BendingOf<R>& sum, Vec3<R> x, Vec3<R> t) const {
    R speed_x[max_lane_gates], speed_y[max_lane_gates], slowness[max_lane_gates];
    for (int g = 0; g < scene_.gate_count; ++g) {
      const Vec3<R> way = way_of(g, t, speed_x, speed_y);
      speed_x[g] = nearest_[g].speed_x(way);
      speed_y[g] = nearest_[g].speed_y(way);
      slowness[g] = slowness_of(speed_x[g], speed_y[g]);
    }
    sum.acceleration += through_gates(x, [&](int g, const Source& source, R gm) {
      const R inverse4 = source.inverse2 * source.inverse2;
      sum.stiffness = multiply_add(source.pull * source.inverse2, R(distant_weight) * slowness[g],
                                   sum.stiffness);
      sum.nearness =
          select(gm > R(0), multiply_add(inverse4, slowness[g], sum.nearness), sum.nearness);
      sum.gradient = multiply_add(R(2) * source.pull, nearest_[g].moves(), sum.gradient);
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

  /// As of `LaneMasses`.
  void find_changes(FirstMeeting<R>& first, Mask which, const LanePath<R>& path, R over) const {
    const Vec3<R> end = path.place.at(last_look(path, over));
    Mask may[max_lane_gates];
    if (may_change_gates(may, which, path, end)) find_gates(first, may, path, over);
  }

  /// Where a mass seen_ through a gate is so near that floats can't follow the light: `bare2`.
  [[nodiscard]] Mask too_near(Vec3<R> x) const {
    Mask found = R(1) < R(0);
    if (!scene_.bare_through) return found;
    R qx[max_lane_gates], qy[max_lane_gates];
    for (int g = 0; g < scene_.gate_count; ++g) {
      const Vec3<R> local = local_of(g, x, qx, qy);
      qx[g] = nearest_[g].x(local);
      qy[g] = nearest_[g].y(local);
      for (int i = 0; i < scene_.mass_count; ++i) {
        const Vec3<R> d = spread<R>(scene_.gates[g].images[i]) - Vec3<R>{qx[g], qy[g], R(0)};
        found = found | ((reached_[g] > R(0)) & (dot(d, d) < R(scene_.gates[g].bare2[i])));
      }
    }
    return found;
  }

  static constexpr bool sees_borders_far_off = true;
  static constexpr bool foresees_planes = true;

 private:
  using Source = MassPull<R>;

  /// Where on a straight path a mass begins or ceases to act through a gate, or a gate with a
  /// parent.
  [[nodiscard]] R until_faded(Vec3<R> x, Vec3<R> t) const {
    R least(never);
    R qx[max_lane_gates], qy[max_lane_gates], vx[max_lane_gates], vy[max_lane_gates];
    for (int g = 0; g < scene_.gate_count; ++g) {
      const LaneGate& gate = scene_.gates[g];
      const Vec3<R> local = local_of(g, x, qx, qy), way = way_of(g, t, vx, vy);
      qx[g] = nearest_[g].x(local);
      qy[g] = nearest_[g].y(local);
      vx[g] = nearest_[g].speed_x(way);
      vy[g] = nearest_[g].speed_y(way);
      const auto acts = reached_[g] > R(0);
      if (gate.falls_short) {
        const Vec3<R> from{local.x - qx[g], local.y - qy[g], local.z};
        const Vec3<R> rate{way.x - vx[g], way.y - vy[g], way.z};
        const R ends =
            until_sphere(acts, -dot(from, rate), dot(from, from) - R(gate.reach2), dot(rate, rate));
        least = min(least, select(reached_[gate.parent] > R(0), ends, R(never)));
      }
      const R speed2 = multiply_add(vx[g], vx[g], vy[g] * vy[g]);
      for (int i = 0; i < scene_.mass_count; ++i) {
        if (!gate.fades[i]) continue;
        const Vec3<R> d = spread<R>(gate.images[i]) - Vec3<R>{qx[g], qy[g], R(0)};
        const R ends = until_sphere(seen_[g][i] > R(0), multiply_add(d.x, vx[g], d.y * vy[g]),
                                    dot(d, d) - R(scene_.masses[i].influence2), speed2);
        least = min(least, select(acts, ends, R(never)));
      }
    }
    return least;
  }

  /// Of each gate, false only where all that was decided about it holds along the path; whether
  /// there is a lane where it is not.
  /// @param end  where the path ends, nearly
  [[nodiscard]] bool may_change_gates(Mask* may, Mask which, const LanePath<R>& path,
                                      Vec3<R> end) const {
    R qx[max_lane_gates], qy[max_lane_gates], sway_x[max_lane_gates], sway_y[max_lane_gates];
    auto some = R(1) < R(0);
    for (int g = 0; g < scene_.gate_count; ++g) {
      const LaneGate& gate = scene_.gates[g];
      const Vec3<R> start{anchor_x_[g], anchor_y_[g], anchor_z_[g]};
      const Vec3<R> local = local_of(g, end, qx, qy);
      qx[g] = nearest_[g].x(local);
      qy[g] = nearest_[g].y(local);
      const Vec3<R> q0{nearest_[g].x(start), nearest_[g].y(start), R(0)}, q{qx[g], qy[g], R(0)};
      const auto acts = reached_[g] > R(0);
      auto keeps = !which;
      if (gate.parent >= 0) keeps = keeps | !(reached_[gate.parent] > R(0));
      if (gate.parent < 0 || gate.falls_short) {
        const Vec3<R> from = local - q;
        const R square = dot(from, from), inner = max(R(gate.reach) - path.sway, R(0));
        keeps = keeps |
                (acts & (square <= R(gate.reach2)) & (min(apart2_[g], square) <= inner * inner));
        const auto waits = !(acts | keeps);
        if (any(waits)) keeps = keeps | (waits & stays_out_of(g, start, local, path));
      } else {
        keeps = R(0) < R(1);
      }
      const Vec3<R> sway = sway_of(g, path.sway, sway_x, sway_y);
      sway_x[g] = nearest_[g].sway_x(sway);
      sway_y[g] = nearest_[g].sway_y(sway);
      if (any(acts)) keeps = keeps & (keeps_nearest(gate, nearest_[g], start, local, sway) | !acts);
      for (int i = 0; i < scene_.mass_count; ++i)
        if (gate.fades[i] && any(acts)) {
          const Vec3<R> image = spread<R>(gate.images[i]);
          keeps = keeps & (keeps_its_side(seen_[g][i] > R(0), q0 - image, q - image,
                                          R(scene_.masses[i].influence), path) |
                           !acts);
        }
      may[g] = which & !keeps;
      some = some | may[g];
    }
    return any(some);
  }

  /// True only where a path stays out of reach of a gate.
  [[nodiscard]] Mask stays_out_of(int g, Vec3<R> start, Vec3<R> end,
                                  const LanePath<R>& path) const {
    const LaneGate& gate = scene_.gates[g];
    const Nearest last = Nearest::on(gate, end);
    const Vec3<R> q0{nearest_[g].x(start), nearest_[g].y(start), R(0)},
        q1{last.x(end), last.y(end), R(0)};
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
        qx[g] = nearest_point.x(local);
        qy[g] = nearest_point.y(local);
        if (!asked[g]) continue;
        const Vec3<R> q{qx[g], qy[g], R(0)}, from = local - q;
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
          if (looks_at)
            first.offer_ball(still & acts, seen_[g][i] > R(0), R(scene_.masses[i].influence),
                             to_masses, gap, span, [&] { return faded_on(g, i, path); });
        }
      }
  }

  /// How far a mass is, on a path, from the nearest point of a gate that it acts through.
  [[nodiscard]] LaneSquare<R> faded_on(int g, int i, const LanePath<R>& path) const {
    const LocalPath<R> q = nearest_[g].led_by(seen_from(g, path));
    const LaneVec& image = scene_.gates[g].images[i];
    return {q.x + R(-image.x),
            q.y + R(-image.y),
            {R(image.z), R(0), R(0), R(0), R(0), R(0)},
            R(scene_.masses[i].influence2)};
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
    if (gate.parent < 0) return LocalPath<R>::over(gate, path);
    const LocalPath<R> q = nearest_[gate.parent].led_by(seen_from(gate.parent, path));
    return {q.x * R(gate.by_x.x) + q.y * R(gate.by_y.x) + R(gate.offset.x),
            q.x * R(gate.by_x.y) + q.y * R(gate.by_y.y) + R(gate.offset.y),
            q.x * R(gate.by_x.z) + q.y * R(gate.by_y.z) + R(gate.offset.z)};
  }

  /// What comes through the gates; `tell` hears of every mass seen_ through one.
  template <class Tell>
  [[nodiscard]] Vec3<R> through_gates(Vec3<R> x, const Tell& tell) const {
    R qx[max_lane_gates], qy[max_lane_gates];
    R ax[max_lane_gates], ay[max_lane_gates], az[max_lane_gates];
    for (int g = 0; g < scene_.gate_count; ++g) {
      const Vec3<R> local = local_of(g, x, qx, qy);
      qx[g] = nearest_[g].x(local);
      qy[g] = nearest_[g].y(local);
      ax[g] = ay[g] = az[g] = R(0);
      for (int i = 0; i < scene_.mass_count; ++i) {
        const Vec3<R> to_mass = spread<R>(scene_.gates[g].images[i]) - Vec3<R>{qx[g], qy[g], R(0)};
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

  [[nodiscard]] Vec3<R> local_of(int g, Vec3<R> x, const R* qx, const R* qy) const {
    const LaneGate& gate = scene_.gates[g];
    if (gate.parent < 0)
      return to_axes(x - spread<R>(gate.origin), gate.right, gate.up, gate.normal);
    return multiply_add(
        spread<R>(gate.by_y), qy[gate.parent],
        multiply_add(spread<R>(gate.by_x), qx[gate.parent], spread<R>(gate.offset)));
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
