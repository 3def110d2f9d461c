/// \file
/// Over lanes: the nearest point of a portal that is an ellipse or any simple polygon, for scenes
/// that have both.
#pragma once

#include <type_traits>

#include "lanes/ellipse_face.h"
#include "lanes/simple_outline.h"

namespace portalens {

/// The feature that is nearest: of a gate's ellipse, or of its polygon. Which it is, is the gate's
/// own, so that all lanes go the same way.
template <class R>
struct LaneAnyNearest {
  using Mask = typename R::Mask;
  using Kind = LaneOutline::Kind;

  Kind kind;
  LaneEllipseNearest<R> round;
  LaneOutlineNearest<R> convex;
  LaneSimpleNearest<R> simple;

  template <class Gate>
  [[nodiscard]] static LaneAnyNearest on(const Gate& gate, Vec3<R> local) {
    LaneAnyNearest found;
    found.kind = gate.outline->kind;
    found.with([&](auto& its) { its = std::remove_reference_t<decltype(its)>::on(gate, local); });
    return found;
  }
  /// What `use` makes of the one that it is.
  template <class Use>
  auto with(const Use& use) {
    return kind == Kind::ellipse ? use(round) : kind == Kind::convex ? use(convex) : use(simple);
  }
  template <class Use>
  auto with(const Use& use) const {
    return kind == Kind::ellipse ? use(round) : kind == Kind::convex ? use(convex) : use(simple);
  }

  [[nodiscard]] Vec3<R> place(Vec3<R> local) const {
    return with([&](const auto& its) { return its.place(local); });
  }
  [[nodiscard]] R moves() const {
    return with([](const auto& its) { return its.moves(); });
  }
  [[nodiscard]] R speed_x(Vec3<R> way) const {
    return with([&](const auto& its) { return its.speed_x(way); });
  }
  [[nodiscard]] R speed_y(Vec3<R> way) const {
    return with([&](const auto& its) { return its.speed_y(way); });
  }
  /// As of a `LaneEllipseNearest`.
  [[nodiscard]] R swings() const { return is_round() ? round.swings() : R(0); }
  [[nodiscard]] R fastest(R h) const { return is_round() ? round.fastest(h) : R(1); }
  [[nodiscard]] LaneAnyNearest moved_to(Vec3<R> local) const {
    LaneAnyNearest found = *this;
    if (is_round()) found.round = round.moved_to(local);
    return found;
  }
  /// Of the same gate.
  void take(Mask where, const LaneAnyNearest& other) {
    if (is_round())
      round.take(where, other.round);
    else if (kind == Kind::convex)
      convex.take(where, other.convex);
    else
      simple.take(where, other.simple);
  }
  [[nodiscard]] bool is_round() const { return kind == Kind::ellipse; }
};

template <class R, class Gate>
[[nodiscard]] typename R::Mask is_behind(const Gate& gate, const LaneAnyNearest<R>& found,
                                         Vec3<R> local) {
  return found.with([&](const auto& its) { return is_behind(gate, its, local); });
}

template <class R>
[[nodiscard]] typename R::Mask runs_round(const LaneAnyNearest<R>& found) {
  return found.is_round() ? runs_round(found.round) : R(1) < R(0);
}

template <class R, class Gate>
[[nodiscard]] typename R::Mask has_other_nearest(const Gate& gate, const LaneAnyNearest<R>& found,
                                                 Vec3<R> local) {
  return found.with([&](const auto& its) { return has_other_nearest(gate, its, local); });
}

template <class R, class Gate>
[[nodiscard]] typename R::Mask keeps_nearest(const Gate& gate, const LaneAnyNearest<R>& found,
                                             Vec3<R> start, Vec3<R> end, Vec3<R> sway) {
  return found.with([&](const auto& its) { return keeps_nearest(gate, its, start, end, sway); });
}

template <class R, class Gate>
void offer_borders(FirstMeeting<R>& first, const Gate& gate, const LaneAnyNearest<R>& found,
                   typename R::Mask may, const LocalPath<R>& path, LaneSpan<R> span) {
  found.with([&](const auto& its) { offer_borders(first, gate, its, may, path, span); });
}

template <class R, class Gate>
[[nodiscard]] LaneBorder<R> until_other_nearest(const Gate& gate, const LaneAnyNearest<R>& found,
                                                typename R::Mask features, Vec3<R> local,
                                                Vec3<R> way, Vec3<R> turn) {
  return found.with(
      [&](const auto& its) { return until_other_nearest(gate, its, features, local, way, turn); });
}

/// The nearest point along a path.
template <class R>
struct LaneLed {
  const LaneAnyNearest<R>& found;
  LocalPath<R> path;

  [[nodiscard]] Vec3<R> place(R u) const { return found.place(local(u)); }
  [[nodiscard]] Vec3<R> speed(R u) const {
    const Vec3<R> way{path.x.slope(u), path.y.slope(u), R(0)};
    const LaneAnyNearest<R> now = found.moved_to(local(u));
    return {now.speed_x(way), now.speed_y(way), R(0)};
  }

  /// How far it is beyond a line in the plane.
  struct Beyond {
    const LaneLed& led;
    Vec3<R> normal;
    R line;

    [[nodiscard]] R at(R u) const { return dot(led.place(u), normal) - line; }
    [[nodiscard]] R slope(R u) const { return dot(led.speed(u), normal); }
  };
  [[nodiscard]] Beyond beyond(R normal_x, R normal_y, R line) const {
    return {*this, {normal_x, normal_y, R(0)}, line};
  }

 private:
  [[nodiscard]] Vec3<R> local(R u) const { return {path.x.at(u), path.y.at(u), path.z.at(u)}; }
};

/// How far a mass, as seen through a face, is from the nearest point of that, squared, less the
/// square of its influence.
template <class R>
struct LaneAnyFading {
  LaneLed<R> led;
  Vec3<R> image;
  R influence2;

  [[nodiscard]] R at(R u) const {
    const Vec3<R> d = led.place(u) - image;
    return dot(d, d) - influence2;
  }
  [[nodiscard]] R slope(R u) const { return R(2) * dot(led.place(u) - image, led.speed(u)); }
};

}  // namespace portalens
