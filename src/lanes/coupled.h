/// \file
/// The field over lanes where a coupling adds to that of masses.
#pragma once

#include "lanes/few_masses.h"

namespace portalens {

/// Masses directly, and `Through` through portals. `Through` has, as `LaneMasses` does,
/// `acceleration`, `find_changes`, `too_near`, `sees_borders_far_off`, `foresees_planes`, and
///   void decide(Vec3<R> anchor);
///   Mask acting() const;
///   void add_to(BendingOf<R>& sum, Vec3<R> x, Vec3<R> t) const;
///   LaneBorder<R> boundary(Vec3<R> x, Vec3<R> t, Vec3<R> bend, Mask acting, R limit) const;
/// where `acting` is where anything acts.
template <class R, class Through>
struct LaneCoupled {
  using Weight = UniformWeight;
  LaneMasses<R> direct;
  Through through;
  typename R::Mask acting;

  explicit LaneCoupled(const LaneScene& scene)
      : direct(scene), through(scene), acting(R(1) < R(0)) {}

  void decide(Vec3<R> x, Vec3<R> t) {
    direct.decide(x, t);
    through.decide(multiply_add(t, R(direct.scene.ahead), x));
    acting = direct.acting | through.acting();
  }
  [[nodiscard]] BendingOf<R> bending(Vec3<R> x, Vec3<R> t) const {
    BendingOf<R> sum = direct.bending(x, t);
    through.add_to(sum, x, t);
    return sum;
  }
  [[nodiscard]] Vec3<R> acceleration(Vec3<R> x) const {
    return direct.acceleration(x) + through.acceleration(x);
  }
  void find_changes(FirstMeeting<R>& first, typename R::Mask which, const LanePath<R>& path,
                    R over) const {
    direct.find_changes(first, which, path, over);
    through.find_changes(first, which, path, over);
  }
  [[nodiscard]] typename R::Mask too_near(Vec3<R> x) const { return through.too_near(x); }
  [[nodiscard]] int mass_count() const { return direct.mass_count(); }
  [[nodiscard]] const LaneMass& mass(int i) const { return direct.mass(i); }
  [[nodiscard]] static int object_of(int i) { return i; }
  [[nodiscard]] R distance2(int mass) const { return direct.distance2(mass); }
  [[nodiscard]] R ahead(int mass) const { return direct.ahead(mass); }
  static constexpr bool sees_borders_far_off = Through::sees_borders_far_off;
  static constexpr bool foresees_planes = Through::foresees_planes;
  static constexpr bool may_lack_room = false;

  [[nodiscard]] LaneBorder<R> boundary(Vec3<R> x, Vec3<R> t, Vec3<R> bend, R limit) {
    LaneBorder<R> first = direct.boundary(x, t, bend, limit);
    first.offer(through.boundary(x, t, bend, acting, min(first.at, limit)));
    return first;
  }
};

}  // namespace portalens
