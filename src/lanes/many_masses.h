/// \file
/// The field over lanes of more masses than `LaneMasses` holds: each step asks those that act on a
/// lane of its pack, which a grid tells.
#pragma once

#include "lanes/border.h"
#include "lanes/face_axes.h"
#include "lanes/first_meeting.h"
#include "lanes/mass_grid_walk.h"
#include "lanes/path.h"
#include "lanes/pull.h"

namespace portalens {

/// The decisions of one step. A mass that a lane does not list adds exactly nothing to what is told
/// of that lane, so nothing depends on who travels beside it.
template <class R>
struct LaneManyMassesField {
  using Weight = UniformWeight;
  const LaneScene& scene;
  const LaneManyMasses& many;
  int count = 0;                        ///< of the masses that act or absorb where a lane is
  std::uint32_t listed[max_lane_near];  ///< ascending
  R inside[max_lane_near];              ///< G M / c² where the influence holds, else 0
  /// From the step's start, as in `LaneMasses`; a mass that a lane does not list is far off.
  R squares[max_lane_near], along[max_lane_near];
  R missed;  ///< `LaneAhead::missed` of the step
  typename R::Mask acting, lacks_room;

  explicit LaneManyMassesField(const LaneScene& the_scene)
      : scene(the_scene),
        many(the_scene.many),
        missed(0),
        acting(R(1) < R(0)),
        lacks_room(R(1) < R(0)) {}

  void decide(Vec3<R> x, Vec3<R> t) {
    LaneMarks<R> marks(many.count);
    lacks_room = LaneMassGrid<R>(many, x, t, scene.ahead).mark(marks);
    const R far(1e4f * scene.radius * scene.radius);
    marks.for_each([&](std::uint32_t index) {
      const LaneMass& mass = many.masses[index];
      const Vec3<R> to_mass = spread<R>(mass.center) - x;
      const R square = dot(to_mass, to_mass), towards = dot(to_mass, t);
      const R begun = subtract_product(square, R(2) * R(scene.ahead), towards);
      const auto within = begun < R(mass.influence2);
      const auto here = mass.horizon > mass.influence ? begun < R(mass.horizon2) : within;
      listed[count] = index;
      squares[count] = select(here, square, far);
      along[count] = towards;
      inside[count] = select(within, R(mass.gm), R(0));
      acting = acting | within;
      ++count;
    });
  }

  [[nodiscard]] int mass_count() const { return count; }
  [[nodiscard]] const LaneMass& mass(int i) const { return many.masses[listed[i]]; }
  [[nodiscard]] int object_of(int i) const {
    return first_many_object + static_cast<int>(listed[i]);
  }
  [[nodiscard]] R distance2(int mass) const { return squares[mass]; }
  [[nodiscard]] R ahead(int mass) const { return along[mass]; }

  [[nodiscard]] BendingOf<R> bending(Vec3<R> x, Vec3<R>) const {
    BendingOf<R> sum{{R(0), R(0), R(0)}, R(0), R(0), R(0), R(0)};
    for (int i = 0; i < count; ++i)
      add_bending(sum, mass(i), spread<R>(mass(i).center) - x, squares[i], along[i], inside[i]);
    return sum;
  }

  [[nodiscard]] Vec3<R> acceleration(Vec3<R> x) const {
    Vec3<R> sum{R(0), R(0), R(0)};
    for (int i = 0; i < count; ++i)
      (void)add_pull(sum, mass(i), spread<R>(mass(i).center) - x, inside[i]);
    return sum;
  }

  /// As of `LaneMasses`; what acts and what absorbs is left or entered there.
  [[nodiscard]] LaneBorder<R> boundary(Vec3<R> x, Vec3<R> t, Vec3<R> bend, R limit) {
    const R bend2 = dot(bend, bend);
    R least(never);
    for (int i = 0; i < count; ++i) {
      const auto within = inside[i] > R(0);
      const R inward = dot(spread<R>(mass(i).center) - x, bend);
      const R leaves = until_sphere_on_curve(within, along[i], squares[i] - R(mass(i).influence2),
                                             inward, bend2);
      least = min(least, select(within, leaves, R(never)));
    }
    const LaneAhead<R> ahead =
        LaneMassGrid<R>(many, x, t, scene.ahead).look_ahead(bend, min(least, limit));
    missed = ahead.missed;
    LaneBorder<R> first;
    first.offer(min(least, ahead.entry));
    return first;
  }

  /// Where the path leaves or enters a ball sooner than `boundary` has foreseen.
  void find_changes(FirstMeeting<R>& first, typename R::Mask which, const LanePath<R>& path,
                    R over) const {
    const LaneLooks<R> looks(path, over);
    const Vec3<R> end = looks.place[LaneLooks<R>::count - 1];
    const auto offer = [&](typename R::Mask changed, Vec3<R> center, R radius2, R side) {
      const LaneDistance<R> outside{path, center, radius2};
      const R guess = outside.surface_from(select(side > R(0), R(1), R(0)), -side);
      first.share =
          select(changed, min(first.share, crossing(changed, outside, guess, side, R(0), R(1))),
                 first.share);
    };
    for (int i = 0; i < count; ++i) {
      const Vec3<R> center = spread<R>(mass(i).center), from = end - center;
      const R radius2(mass(i).influence2);
      const auto left = which & (inside[i] > R(0)) & (dot(from, from) > radius2);
      if (any(left)) offer(left, center, radius2, R(-1));
    }
    const LaneMassGrid<R> grid(many, path.place.c0, path.place.c1 * (R(1) / path.h), scene.ahead);
    const LaneBall<R> ball = grid.entered(which & acting, end);
    const auto entered = ball.radius2 > R(0);
    if (any(entered)) offer(entered, ball.center, ball.radius2, R(1));
    // Where the path strays from its parabola it may graze a ball that this one passed by.
    const R strays = span(path.place.c3) + span(path.place.c4) + span(path.place.c5);
    const auto may_graze = which & acting & (strays > missed);
    if (any(may_graze)) first.share = min(first.share, grid.first_entry(may_graze, path, over));
  }

  /// Nothing acts through portals.
  [[nodiscard]] typename R::Mask too_near(Vec3<R>) const { return R(1) < R(0); }

  /// As of `LaneMasses`.
  static constexpr bool sees_borders_far_off = true;
  static constexpr bool foresees_planes = false;
  static constexpr bool may_lack_room = true;
};

}  // namespace portalens
