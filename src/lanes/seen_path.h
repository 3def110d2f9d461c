/// \file
/// The path of a lane's step where it may meet what boxes hold, in double.
#pragma once

#include <limits>
#include <optional>

#include "lanes/scene.h"
#include "photon/curve.h"
#include "photon/obstacles.h"
#include "photon/ray_state.h"

namespace portalens {

class SeenPath {
 public:
  /// @param from  where it begins
  SeenPath(const LaneSeen& seen, int lane, const State& from)
      : from_(from),
        curve_(curve_of(seen, lane, from)),
        straight_(seen.bend[lane] == 0.0f),
        rough_(seen.rough[lane] > 0.0f) {}

  [[nodiscard]] double length() const { return curve_.length(); }
  /// Within it a path is not as exact as at its end.
  [[nodiscard]] bool rough() const { return rough_; }
  /// The length from the start within which nothing is met, as far as `first` has asked.
  [[nodiscard]] double free() const { return free_; }

  /// What it meets first.
  /// @param endless    it goes on, if it is straight
  /// @param tolerance  of its direction, radians
  /// @param length     of the path before it
  [[nodiscard]] std::optional<Encounter> first(const Obstacles& obstacles, const PathStart& start,
                                               bool endless, double tolerance, double length) {
    const double h = curve_.length();
    if (straight_)
      return obstacles.first(Ray{from_.position, from_.direction},
                             endless ? std::numeric_limits<double>::infinity() : h, start);
    free_ = obstacles.clearance(from_.position, 8.0 * h);
    if (free_ >= h) return std::nullopt;
    return obstacles.first(curve_, free_, 0.5 * tolerance * (length + h), start);
  }

  /// Leads a photon on from its start.
  void lead(RayState& way, double s) const {
    way.state = straight_ ? State{from_.position + from_.direction * s, from_.direction}
                          : State{curve_.position(s), curve_.direction(s)};
    way.start = way.start.after(s);
    way.arrival.length += s;
    way.arrival.turning += straight_ ? 0.0 : curve_.turning(s);
  }

 private:
  [[nodiscard]] static Curve curve_of(const LaneSeen& seen, int lane, const State& from) {
    const double share = seen.share[lane], h = share * seen.h[lane];
    Vec3d c[6] = {from.position, from.direction * h};
    double power = share;
    for (int k = 2; k < 6; ++k) {
      power *= share;
      c[k] = Vec3d{seen.cx[k][lane], seen.cy[k][lane], seen.cz[k][lane]} * power;
    }
    return {c, seen.bend[lane], h};
  }

  State from_;
  Curve curve_;
  bool straight_, rough_;
  double free_ = 0.0;
};

/// Whether what is met is what the lane's event says anyhow.
/// @param object  of the event
[[nodiscard]] inline bool says_the_same(LaneEvent event, float object, const Encounter& met) {
  if (met.kind != Encounter::Kind::surface) return event == LaneEvent::portal;
  return event == LaneEvent::hit &&
         met.object == static_cast<std::uint32_t>(static_cast<int>(object));
}

}  // namespace portalens
