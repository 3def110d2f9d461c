/// \file
/// The field over lanes: masses directly, and `closest-point` through portals. What is decided at a
/// step's start stays frozen over it, as in `Field`.
#pragma once

#include "photon/lane_pull.h"
#include "photon/lane_scene.h"

namespace portalens {

/// The decisions of one step.
/// @tparam Foot  the nearest feature of a portal: of a rectangle, or `LaneOutlineFoot`
template <class R, class Foot = LaneFoot<R>>
struct LaneField {
  const LaneScene& scene;
  R inside[most_lane_masses];  ///< G M / c² where the influence holds, else 0
  /// Of each mass, from the step's start: square of its distance, and how far ahead it is.
  R squares[most_lane_masses], along[most_lane_masses];
  Foot feet[most_lane_gates];
  /// For which place that was decided, in the gate's coordinates.
  R anchor_x[most_lane_gates], anchor_y[most_lane_gates], anchor_z[most_lane_gates];
  R apart2[most_lane_gates];                  ///< square of its distance from the nearest point
  R reached[most_lane_gates];                 ///< 1 where the gate acts
  R seen[most_lane_gates][most_lane_masses];  ///< as `inside`, through the gate
  typename R::Mask acting;

  explicit LaneField(const LaneScene& the_scene) : scene(the_scene), acting(R(1) < R(0)) {}

  /// Decides everything for a step from x in the direction t, slightly ahead.
  void decide(Vec3<R> x, Vec3<R> t) {
    acting = R(1) < R(0);
    const R ahead(scene.ahead);
    for (int i = 0; i < scene.mass_count; ++i) {
      const LaneMass& mass = scene.masses[i];
      const Vec3<R> to_mass = spread<R>(mass.center) - x;
      squares[i] = dot(to_mass, to_mass);
      along[i] = dot(to_mass, t);
      const auto within = subtract_product(squares[i], R(2) * ahead, along[i]) < R(mass.influence2);
      inside[i] = select(within, R(mass.gm), R(0));
      acting = acting | within;
    }
    if (scene.gate_count > 0) decide_gates(multiply_add(t, ahead, x));
  }

  /// The masses that may absorb within the step, each by its place among these; and what an event
  /// calls it.
  [[nodiscard]] int mass_count() const { return scene.mass_count; }
  [[nodiscard]] const LaneMass& mass(int i) const { return scene.masses[i]; }
  [[nodiscard]] static int object_of(int i) { return i; }
  /// Square of the distance of a mass from the step's start.
  [[nodiscard]] R distance2(int mass) const { return squares[mass]; }
  /// How far ahead of it the mass is.
  [[nodiscard]] R ahead(int mass) const { return along[mass]; }

  /// What a step of the direction `t` is chosen from, and its first acceleration.
  [[nodiscard]] LaneBending<R> bending(Vec3<R> x, Vec3<R> t) const {
    LaneBending<R> sum{{R(0), R(0), R(0)}, R(0), R(0), R(0)};
    for (int i = 0; i < scene.mass_count; ++i) {
      const LaneMass& mass = scene.masses[i];
      add_bending(sum, mass, spread<R>(mass.center) - x, squares[i], along[i], inside[i]);
    }
    if (scene.gate_count > 0) sum.acceleration += bending_of_gates(x, t, sum);
    return sum;
  }

  [[nodiscard]] Vec3<R> acceleration(Vec3<R> x) const {
    Vec3<R> sum{R(0), R(0), R(0)};
    for (int i = 0; i < scene.mass_count; ++i) {
      const LaneMass& mass = scene.masses[i];
      add_pull(sum, mass, spread<R>(mass.center) - x, inside[i]);
    }
    if (scene.gate_count > 0) sum += through_gates(x, [](int, const Source&, R) {});
    return sum;
  }

  /// Arc length along the parabola x + t s + bend s²/2 to the next place where a decision changes,
  /// or `never`; changes beyond `most` need not be found.
  [[nodiscard]] R boundary(Vec3<R> x, Vec3<R> t, Vec3<R> bend, R most) const {
    R least(never);
    const R bend2 = dot(bend, bend);
    for (int i = 0; i < scene.mass_count; ++i) {
      const LaneMass& mass = scene.masses[i];
      // Mostly no influence ends or begins within a step.
      const R influence(mass.influence);
      const auto within = inside[i] > R(0);
      const R reach = influence + select(within, -most, most);
      const auto nearer = (squares[i] < reach * reach) & (reach > R(0));
      const auto comes = (within & !nearer) | (nearer & !within);
      if (!any(comes)) continue;
      const R inward = dot(spread<R>(mass.center) - x, bend);
      const R s =
          until_sphere_on_curve(within, along[i], squares[i] - R(mass.influence2), inward, bend2);
      least = min(least, select(comes, s, R(never)));
    }
    for (int g = 0; g < scene.gate_count; ++g) {
      const LaneGate& gate = scene.gates[g];
      if (gate.parent >= 0) continue;
      const Vec3<R> local = to_axes(x - spread<R>(gate.origin), gate.right, gate.up, gate.normal);
      const Vec3<R> way = to_axes(t, gate.right, gate.up, gate.normal);
      const Vec3<R> turn = to_axes(bend, gate.right, gate.up, gate.normal);
      least = min(least, until_other_foot(gate, feet[g], (reached[g] > R(0)) | (!acting), local,
                                          way, turn));
    }
    return scene.fading ? min(least, until_faded(x, t)) : least;
  }

  /// Where within the step what acts changes. Until there the field was as frozen, so the path is
  /// right.
  /// @param over  how far past a border a step ends
  void find_changes(FirstMeeting<R>& first, typename R::Mask which, const LanePath<R>& path,
                    R over) const {
    for (int i = 0; i < scene.mass_count; ++i) {
      const auto may = which & may_pass_border(path, i);
      if (any(may)) find_border(first, may, path, over, i);
    }
    if (scene.gate_count == 0) return;
    const Vec3<R> end = path.place.at(last_look(path, over));
    typename R::Mask may[most_lane_gates];
    if (may_change_gates(may, which, path, end)) find_gates(first, may, path, over);
  }

  /// Where a mass seen through a gate is so near that floats can't follow the light: `bare2`.
  [[nodiscard]] typename R::Mask too_near(Vec3<R> x) const {
    typename R::Mask found = R(1) < R(0);
    if (!scene.bare_through) return found;
    R qx[most_lane_gates], qy[most_lane_gates];
    for (int g = 0; g < scene.gate_count; ++g) {
      const Vec3<R> local = local_of(g, x, qx, qy);
      qx[g] = feet[g].x(local);
      qy[g] = feet[g].y(local);
      for (int i = 0; i < scene.mass_count; ++i) {
        const Vec3<R> d = spread<R>(scene.gates[g].images[i]) - Vec3<R>{qx[g], qy[g], R(0)};
        found = found | ((reached[g] > R(0)) & (dot(d, d) < R(scene.gates[g].bare2[i])));
      }
    }
    return found;
  }

  /// Borders are found however far off they are: where nothing acts, straight flights end there.
  static constexpr bool sees_borders_far_off = true;
  /// No lane has more masses about it than there is room for.
  static constexpr bool may_lack_room = false;

 private:
  void decide_gates(Vec3<R> anchor) {
    R qx[most_lane_gates], qy[most_lane_gates];
    for (int g = 0; g < scene.gate_count; ++g) {
      const LaneGate& gate = scene.gates[g];
      const Vec3<R> local = local_of(g, anchor, qx, qy);
      const R above = gate.parent < 0 ? R(1) : reached[gate.parent];
      anchor_x[g] = local.x;
      anchor_y[g] = local.y;
      anchor_z[g] = local.z;
      feet[g] = Foot::on(gate, local);
      qx[g] = feet[g].x(local);
      qy[g] = feet[g].y(local);
      const Vec3<R> from{local.x - qx[g], local.y - qy[g], local.z};
      apart2[g] = dot(from, from);
      const auto near = (apart2[g] < R(gate.reach2)) & (above > R(0));
      reached[g] = select(near, R(1), R(0));
      acting = acting | near;
      for (int i = 0; i < scene.mass_count; ++i) {
        const Vec3<R> d = spread<R>(gate.images[i]) - Vec3<R>{qx[g], qy[g], R(0)};
        seen[g][i] =
            select(near & (dot(d, d) < R(scene.masses[i].influence2)), R(scene.masses[i].gm), R(0));
      }
    }
  }

  /// Where on a straight way a mass begins or ceases to act through a gate, or a gate with a
  /// parent.
  [[nodiscard]] R until_faded(Vec3<R> x, Vec3<R> t) const {
    R least(never);
    R qx[most_lane_gates], qy[most_lane_gates], vx[most_lane_gates], vy[most_lane_gates];
    for (int g = 0; g < scene.gate_count; ++g) {
      const LaneGate& gate = scene.gates[g];
      const Vec3<R> local = local_of(g, x, qx, qy), way = way_of(g, t, vx, vy);
      qx[g] = feet[g].x(local);
      qy[g] = feet[g].y(local);
      vx[g] = feet[g].speed_x(way);
      vy[g] = feet[g].speed_y(way);
      const auto acts = reached[g] > R(0);
      if (gate.falls_short) {
        const Vec3<R> from{local.x - qx[g], local.y - qy[g], local.z};
        const Vec3<R> rate{way.x - vx[g], way.y - vy[g], way.z};
        const R ends =
            until_sphere(acts, -dot(from, rate), dot(from, from) - R(gate.reach2), dot(rate, rate));
        least = min(least, select(reached[gate.parent] > R(0), ends, R(never)));
      }
      const R speed2 = multiply_add(vx[g], vx[g], vy[g] * vy[g]);
      for (int i = 0; i < scene.mass_count; ++i) {
        if (!gate.fades[i]) continue;
        const Vec3<R> d = spread<R>(gate.images[i]) - Vec3<R>{qx[g], qy[g], R(0)};
        const R ends = until_sphere(seen[g][i] > R(0), multiply_add(d.x, vx[g], d.y * vy[g]),
                                    dot(d, d) - R(scene.masses[i].influence2), speed2);
        least = min(least, select(acts, ends, R(never)));
      }
    }
    return least;
  }

  /// False only where the path stays within the influence of a mass, or out of it.
  [[nodiscard]] typename R::Mask may_pass_border(const LanePath<R>& path, int i) const {
    const auto within = inside[i] > R(0);
    const R radius(scene.masses[i].influence), ahead = along[i];
    const R inner = max(radius - path.h, R(0)), outer = radius + path.h;
    const R aside = radius + path.stray;
    return (within & (squares[i] > inner * inner)) |
           ((!within) & (ahead + path.stray > R(0)) & (squares[i] < outer * outer) &
            (subtract_product(squares[i], ahead, ahead) < aside * aside));
  }

  /// Where the path enters or leaves the influence of a mass.
  [[gnu::noinline]] void find_border(FirstMeeting<R>& first, typename R::Mask may,
                                     const LanePath<R>& path, R over, int i) const {
    const LaneMass& mass = scene.masses[i];
    const Vec3<R> center = spread<R>(mass.center), end = path.place.at(last_look(path, over));
    may = may & !keeps_its_side(inside[i] > R(0), path.place.c0 - center, end - center,
                                R(mass.influence), path);
    if (!any(may)) return;
    const LaneLooks<R> looks(path, over);
    const R gap = path.h * R(1.0 / (LaneLooks<R>::count - 1));
    LaneSpan<R> distances{R(0), squares[i]};
    for (int k = 1; k < LaneLooks<R>::count; ++k) {
      const Vec3<R> from = looks.place[k] - center;
      distances = {distances.high, dot(from, from)};
      first.offer_ball(may & first.open(looks.before(k)), inside[i] > R(0), R(mass.influence),
                       distances, gap, looks.before(k), [&] {
                         return LaneDistance<R>{path, center, R(mass.influence2)};
                       });
    }
  }

  /// Of each gate, false only where all that was decided about it holds along the path; whether
  /// there is a lane where it is not.
  /// @param end  where the path ends, nearly
  [[nodiscard]] bool may_change_gates(typename R::Mask* may, typename R::Mask which,
                                      const LanePath<R>& path, Vec3<R> end) const {
    R qx[most_lane_gates], qy[most_lane_gates], sway_x[most_lane_gates], sway_y[most_lane_gates];
    auto some = R(1) < R(0);
    for (int g = 0; g < scene.gate_count; ++g) {
      const LaneGate& gate = scene.gates[g];
      const Vec3<R> start{anchor_x[g], anchor_y[g], anchor_z[g]};
      const Vec3<R> local = local_of(g, end, qx, qy);
      qx[g] = feet[g].x(local);
      qy[g] = feet[g].y(local);
      const Vec3<R> q0{feet[g].x(start), feet[g].y(start), R(0)}, q{qx[g], qy[g], R(0)};
      const auto acts = reached[g] > R(0);
      auto keeps = !which;
      if (gate.parent >= 0) keeps = keeps | !(reached[gate.parent] > R(0));
      if (gate.parent < 0 || gate.falls_short) {
        const Vec3<R> from = local - q;
        const R square = dot(from, from), inner = max(R(gate.reach) - path.sway, R(0));
        keeps =
            keeps | (acts & (square <= R(gate.reach2)) & (min(apart2[g], square) <= inner * inner));
        const auto waits = !(acts | keeps);
        if (any(waits)) keeps = keeps | (waits & stays_out_of(g, start, local, path));
      } else {
        keeps = R(0) < R(1);
      }
      const Vec3<R> sway = sway_of(g, path.sway, sway_x, sway_y);
      sway_x[g] = feet[g].sway_x(sway);
      sway_y[g] = feet[g].sway_y(sway);
      if (any(acts)) keeps = keeps & (keeps_foot(gate, feet[g], start, local, sway) | !acts);
      for (int i = 0; i < scene.mass_count; ++i)
        if (gate.fades[i] && any(acts)) {
          const Vec3<R> image = spread<R>(gate.images[i]);
          keeps = keeps & (keeps_its_side(seen[g][i] > R(0), q0 - image, q - image,
                                          R(scene.masses[i].influence), path) |
                           !acts);
        }
      may[g] = which & !keeps;
      some = some | may[g];
    }
    return any(some);
  }

  /// True only where a path stays out of reach of a gate.
  [[nodiscard]] typename R::Mask stays_out_of(int g, Vec3<R> start, Vec3<R> end,
                                              const LanePath<R>& path) const {
    const LaneGate& gate = scene.gates[g];
    const Foot last = Foot::on(gate, end);
    const Vec3<R> q0{feet[g].x(start), feet[g].y(start), R(0)}, q1{last.x(end), last.y(end), R(0)};
    // Past the plane the face is at once as near as that.
    const auto behind = is_behind(gate, feet[g], start) | is_behind(gate, last, end);
    const auto below = (start.z < R(0)) & keeps_margin(-start.z, -end.z, path.sway);
    return stays_beyond(R(gate.reach), start - q0, end - q1, path, !behind) & (below | !behind);
  }

  /// Where the nearest point of a gate that acts changes its feature, or where something begins or
  /// ceases to act through one.
  /// @param may  of each gate, the lanes where that may be
  [[gnu::noinline]] void find_gates(FirstMeeting<R>& first, const typename R::Mask* may,
                                    const LanePath<R>& path, R over) const {
    bool asked[most_lane_gates], follows[most_lane_gates] = {};
    // Children stand behind their parents.
    for (int g = scene.gate_count - 1; g >= 0; --g) {
      asked[g] = any(may[g]);
      follows[g] = follows[g] || asked[g];
      if (follows[g] && scene.gates[g].parent >= 0) follows[scene.gates[g].parent] = true;
    }
    const LaneLooks<R> looks(path, over);
    const R gap = path.h * R(1.0 / (LaneLooks<R>::count - 1));
    R qx[most_lane_gates], qy[most_lane_gates], apart[most_lane_gates];
    R faded[most_lane_gates][most_lane_masses];
    for (int k = 0; k < LaneLooks<R>::count; ++k)
      for (int g = 0; g < scene.gate_count; ++g) {
        if (!follows[g]) continue;
        const LaneGate& gate = scene.gates[g];
        const Vec3<R> local = local_of(g, looks.place[k], qx, qy);
        Foot foot = feet[g];
        const auto acts = reached[g] > R(0), other = has_other_foot(gate, foot, local);
        if (any(other & !acts)) foot.take(other & !acts, Foot::on(gate, local));
        qx[g] = foot.x(local);
        qy[g] = foot.y(local);
        if (!asked[g]) continue;
        const Vec3<R> q{qx[g], qy[g], R(0)}, from = local - q;
        const LaneSpan<R> reaches{k > 0 ? apart[g] : R(0), dot(from, from)};
        apart[g] = reaches.high;
        const LaneSpan<R> span = looks.before(k > 0 ? k : 1);
        const auto still = may[g] & first.open(span);
        const bool looks_at = k > 0 && any(still);
        if (looks_at) {
          const auto changed = still & acts & other;
          if (any(changed)) offer_borders(first, gate, feet[g], changed, seen_from(g, path), span);
          if (gate.parent < 0 || gate.falls_short)
            first.offer_ball(still, acts, R(gate.reach), reaches, gap, span, [&] {
              return LaneApart<R, LaneGate, Foot>{gate, seen_from(g, path), feet[g], acts};
            });
        }
        for (int i = 0; i < scene.mass_count; ++i) {
          if (!gate.fades[i]) continue;
          const Vec3<R> to_mass = spread<R>(gate.images[i]) - q;
          const LaneSpan<R> to_masses{k > 0 ? faded[g][i] : R(0), dot(to_mass, to_mass)};
          faded[g][i] = to_masses.high;
          if (looks_at)
            first.offer_ball(still & acts, seen[g][i] > R(0), R(scene.masses[i].influence),
                             to_masses, gap, span, [&] { return faded_on(g, i, path); });
        }
      }
  }

  /// How far a mass is, on a path, from the nearest point of a gate that it acts through.
  [[nodiscard]] LaneSquare<R> faded_on(int g, int i, const LanePath<R>& path) const {
    const LocalPath<R> q = feet[g].led_by(seen_from(g, path));
    const LaneVec& image = scene.gates[g].images[i];
    return {q.x + R(-image.x),
            q.y + R(-image.y),
            {R(image.z), R(0), R(0), R(0), R(0), R(0)},
            R(scene.masses[i].influence2)};
  }

  /// A gate's own direction of the way `t`: through another gate that of its nearest point.
  [[nodiscard]] Vec3<R> way_of(int g, Vec3<R> t, const R* speed_x, const R* speed_y) const {
    const LaneGate& gate = scene.gates[g];
    if (gate.parent < 0) return to_axes(t, gate.right, gate.up, gate.normal);
    return spread<R>(gate.by_x) * speed_x[gate.parent] +
           spread<R>(gate.by_y) * speed_y[gate.parent];
  }

  /// By how much the coordinates in a gate's axes sway: through another gate those of its nearest
  /// point, which may stand still.
  [[nodiscard]] Vec3<R> sway_of(int g, R sway, const R* sway_x, const R* sway_y) const {
    const LaneGate& gate = scene.gates[g];
    if (gate.parent < 0) return {sway, sway, sway};
    const auto positive = [](LaneVec v) {
      return spread<R>({v.x < 0 ? -v.x : v.x, v.y < 0 ? -v.y : v.y, v.z < 0 ? -v.z : v.z});
    };
    return positive(gate.by_x) * sway_x[gate.parent] + positive(gate.by_y) * sway_y[gate.parent];
  }

  /// The path in a gate's coordinates; through another gate that of its nearest point.
  [[nodiscard]] LocalPath<R> seen_from(int g, const LanePath<R>& path) const {
    const LaneGate& gate = scene.gates[g];
    if (gate.parent < 0) return LocalPath<R>::over(gate, path);
    const LocalPath<R> q = feet[gate.parent].led_by(seen_from(gate.parent, path));
    return {q.x * R(gate.by_x.x) + q.y * R(gate.by_y.x) + R(gate.offset.x),
            q.x * R(gate.by_x.y) + q.y * R(gate.by_y.y) + R(gate.offset.y),
            q.x * R(gate.by_x.z) + q.y * R(gate.by_y.z) + R(gate.offset.z)};
  }

  using Source = LanePull<R>;

  /// What comes through the gates depends on where the points of their faces are, not on where
  /// the photon is: steps are the longer the slower those move.
  [[nodiscard]] Vec3<R> bending_of_gates(Vec3<R> x, Vec3<R> t, LaneBending<R>& sum) const {
    R speed_x[most_lane_gates], speed_y[most_lane_gates], slowness[most_lane_gates];
    for (int g = 0; g < scene.gate_count; ++g) {
      const Vec3<R> way = way_of(g, t, speed_x, speed_y);
      speed_x[g] = feet[g].speed_x(way);
      speed_y[g] = feet[g].speed_y(way);
      slowness[g] = slowness_of(speed_x[g], speed_y[g]);
    }
    return through_gates(x, [&](int g, const Source& source, R gm) {
      const R inverse4 = source.inverse2 * source.inverse2;
      sum.stiffness = multiply_add(source.pull * source.inverse2, R(distant_weight) * slowness[g],
                                   sum.stiffness);
      sum.nearness =
          select(gm > R(0), multiply_add(inverse4, slowness[g], sum.nearness), sum.nearness);
      sum.gradient = multiply_add(R(2) * source.pull, feet[g].moves(), sum.gradient);
    });
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
        const Source source =
            Source::of(dot(to_mass, to_mass) + R(scene.masses[i].core2), seen[g][i]);
        ax[g] = multiply_add(to_mass.x, source.pull, ax[g]);
        ay[g] = multiply_add(to_mass.y, source.pull, ay[g]);
        az[g] = multiply_add(to_mass.z, source.pull, az[g]);
        tell(g, source, seen[g][i]);
      }
    }
    // Children stand behind their parents.
    Vec3<R> sum{R(0), R(0), R(0)};
    for (int g = scene.gate_count - 1; g >= 0; --g) {
      const LaneGate& gate = scene.gates[g];
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
    const LaneGate& gate = scene.gates[g];
    if (gate.parent < 0)
      return to_axes(x - spread<R>(gate.origin), gate.right, gate.up, gate.normal);
    return multiply_add(
        spread<R>(gate.by_y), qy[gate.parent],
        multiply_add(spread<R>(gate.by_x), qx[gate.parent], spread<R>(gate.offset)));
  }
};

}  // namespace portalens
