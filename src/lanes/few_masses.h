/// \file
/// The field over lanes of a few masses. What is decided at a step's start stays frozen over it, as
/// in `Field`.
#pragma once

#include "lanes/border.h"
#include "lanes/face_axes.h"
#include "lanes/first_meeting.h"
#include "lanes/path.h"
#include "lanes/pull.h"
#include "lanes/scene.h"

namespace portalens {

/// The decisions of one step.
/// @tparam W  the `Weighing` of the law
template <class R, class W = UniformWeight>
struct LaneMasses {
  using Weight = W;
  const LaneScene& scene;
  R inside[max_lane_masses];  ///< G M / c² where the influence holds, else 0
  /// Of each mass, from the step's start: square of its distance, and how far ahead it is.
  R squares[max_lane_masses], along[max_lane_masses];
  bool near_border[max_lane_masses];  ///< whether the step may pass it in some lane
  typename R::Mask acting;

  explicit LaneMasses(const LaneScene& the_scene) : scene(the_scene), acting(R(1) < R(0)) {}

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
  [[nodiscard]] BendingOf<R> bending(Vec3<R> x, [[maybe_unused]] Vec3<R> t) const {
    BendingOf<R> sum{{R(0), R(0), R(0)}, R(0), R(0), R(0), R(0)};
    if constexpr (W::uniform) {
      for (int i = 0; i < scene.mass_count; ++i) {
        const LaneMass& mass = scene.masses[i];
        add_bending(sum, mass, spread<R>(mass.center) - x, squares[i], along[i], inside[i]);
      }
    } else {
      const R w = potential(x), weight = W::weight(w);
      for (int i = 0; i < scene.mass_count; ++i) {
        const LaneMass& mass = scene.masses[i];
        add_weighted_bending(sum, mass, spread<R>(mass.center) - x, squares[i], along[i], inside[i],
                             weight);
      }
      sum.sinking = select(sinks(sum, t), R(1), R(0));
      // The weight changes, too: ∇h = h' ∇w.
      const R share = dot(sum.acceleration, sum.acceleration) / (weight * weight);
      add_gradient(sum, abs(W::weight_slope(w)) * share);
    }
    return sum;
  }

  [[nodiscard]] Vec3<R> acceleration(Vec3<R> x) const {
    Vec3<R> sum{R(0), R(0), R(0)};
    R w(0);
    for (int i = 0; i < scene.mass_count; ++i) {
      const LaneMass& mass = scene.masses[i];
      const R found = add_pull(sum, mass, spread<R>(mass.center) - x, inside[i]);
      if constexpr (!W::uniform) w = w + found;
    }
    if constexpr (!W::uniform) sum = sum * W::weight(w);
    return sum;
  }

  /// w, Σ m/d over the masses that act.
  [[nodiscard]] R potential(Vec3<R> x) const {
    R w(0);
    for (int i = 0; i < scene.mass_count; ++i) w = w + part_of_potential(x, i);
    return w;
  }
  /// The mass that counts for most in it.
  [[nodiscard]] R deepest(Vec3<R> x) const {
    R most(0), which(0);
    for (int i = 0; i < scene.mass_count; ++i) {
      const R part = part_of_potential(x, i);
      which = select(part > most, R(object_of(i)), which);
      most = max(part, most);
    }
    return which;
  }
  /// How much w grows with a displacement by that.
  [[nodiscard]] R potential_slope(Vec3<R> x, Vec3<R> by) const {
    Vec3<R> sum{R(0), R(0), R(0)};
    for (int i = 0; i < scene.mass_count; ++i)
      (void)add_pull(sum, scene.masses[i], spread<R>(scene.masses[i].center) - x, inside[i]);
    return dot(sum, by);
  }

  /// Arc length along the parabola x + t s + bend s²/2 to the next place where a decision changes,
  /// or `never`; changes beyond `most`, which no step is longer than, need not be found.
  [[nodiscard]] LaneBorder<R> boundary(Vec3<R> x, Vec3<R>, Vec3<R> bend, R most) {
    LaneBorder<R> first;
    const R bend2 = dot(bend, bend);
    for (int i = 0; i < scene.mass_count; ++i) {
      const LaneMass& mass = scene.masses[i];
      // Mostly no influence ends or begins within a step.
      const R influence(mass.influence);
      const auto within = inside[i] > R(0);
      const R reach = influence + select(within, -most, most);
      const auto nearer = (squares[i] < reach * reach) & (reach > R(0));
      const auto comes = (within & !nearer) | (nearer & !within);
      near_border[i] = any(comes);
      if (!near_border[i]) continue;
      const R inward = dot(spread<R>(mass.center) - x, bend);
      const R s =
          until_sphere_on_curve(within, along[i], squares[i] - R(mass.influence2), inward, bend2);
      first.at = min(first.at, select(comes, s, R(never)));
    }
    return first;
  }

  /// Where within the step what acts changes. Until there the field was as frozen, so the path is
  /// right.
  /// @param over  how far past a border a step ends
  void find_changes(FirstMeeting<R>& first, typename R::Mask which, const LanePath<R>& path,
                    R over) const {
    for (int i = 0; i < scene.mass_count; ++i) {
      if (!near_border[i]) continue;
      auto may = which & may_pass_border(path, i);
      if (any(may)) may = may & !passes_none_sooner(path, over, i);
      if (any(may)) find_border(first, may, path, over, i);
    }
  }

  /// No lane: `LaneMeetings::find_horizons` checks the masses of this field itself.
  [[nodiscard]] static typename R::Mask too_near(Vec3<R>) { return R(1) < R(0); }

  /// Borders are found however far off they are: where nothing acts, straight flights end there.
  static constexpr bool sees_borders_far_off = true;
  /// Some borders are planes.
  static constexpr bool foresees_planes = false;
  /// No lane has more masses about it than there is room for.
  static constexpr bool may_lack_room = false;

 private:
  [[nodiscard]] R part_of_potential(Vec3<R> x, int i) const {
    const Vec3<R> to_mass = spread<R>(scene.masses[i].center) - x;
    return inside[i] * inverse_sqrt(dot(to_mass, to_mass) + R(scene.masses[i].core2));
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

  /// True only where the path does not pass the border of an influence before its last 2 `over`; a
  /// step that was to end at the border passes it there. Where the path bends less than a circle
  /// about the middle would, the square of the distance from there is convex along it, and its
  /// second derivative below 4.
  [[nodiscard]] typename R::Mask passes_none_sooner(const LanePath<R>& path, R over, int i) const {
    const LaneMass& mass = scene.masses[i];
    const Vec3<R> last = path.end.position - spread<R>(mass.center);
    const R outside = dot(last, last) - R(mass.influence2);
    const R gains = R(4) * over * dot(last, path.end.direction);  // the square, over that
    const auto within = inside[i] > R(0);
    const auto convex = path.turn * (R(mass.influence) + path.h) < path.h;
    const auto leaves_late = outside <= max(gains - R(8) * over * over, R(0));
    const auto enters_late = (gains < R(0)) & (outside >= gains);
    return convex & ((within & leaves_late) | (enters_late & !within));
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
};

}  // namespace portalens
