/// \file
/// The lanes of one pack: what they hold, and how a step is written down.
#pragma once

#include "lanes/path.h"
#include "lanes/scene.h"
#include "photon/drift.h"

namespace portalens {

/// A row of `Lanes`.
using LaneRow = float (Lanes::*)[lane_count];

template <class R>
class LanePack {
 public:
  using Mask = typename R::Mask;
  using V = Vec3<R>;

  LanePack(const LaneScene& scene, Lanes& lanes, int first)
      : scene_(scene), lanes_(lanes), first_(first) {}

  [[nodiscard]] R read(LaneRow row) const { return R::load(lanes_.*row + first_); }
  [[nodiscard]] V position() const { return {read(&Lanes::x), read(&Lanes::y), read(&Lanes::z)}; }
  [[nodiscard]] V direction() const {
    return {read(&Lanes::tx), read(&Lanes::ty), read(&Lanes::tz)};
  }
  void write(LaneRow row, R fresh) const { fresh.store(lanes_.*row + first_); }
  /// Where a lane stays, it keeps what it had.
  void write(LaneRow row, Mask stays, R old, R fresh) const {
    write(row, select(stays, old, fresh));
  }

  /// What a step does to the lanes that take it.
  struct Move {
    V from, along;  ///< where it begins
    V place, direction;
    R length, turning;
    R clear;     ///< nothing that boxes hold is met within that much path from its end
    R gradient;  ///< of the acceleration over c² at its start, 1/length²
    R error;     ///< by which it may err, radians
  };
  /// @return which paths keep the limits of length, turning and steps
  [[nodiscard]] Mask take(const Move& move, Mask stays) const {
    write(&Lanes::x, stays, move.from.x, move.place.x);
    write(&Lanes::y, stays, move.from.y, move.place.y);
    write(&Lanes::z, stays, move.from.z, move.place.z);
    write(&Lanes::tx, stays, move.along.x, move.direction.x);
    write(&Lanes::ty, stays, move.along.y, move.direction.y);
    write(&Lanes::tz, stays, move.along.z, move.direction.z);
    write(&Lanes::clear, stays, read(&Lanes::clear), move.clear);
    // After a short step a plane may still be as near as rounding.
    write(&Lanes::departed, stays | (move.length < R(8) * R(scene_.ahead)), read(&Lanes::departed),
          R(-1));
    const R length = add(&Lanes::length, stays, move.length);
    const R turning = add(&Lanes::turning, stays, move.turning);
    const R steps = add(&Lanes::steps, stays, R(1));
    drift(move, stays);
    return (length <= R(scene_.max_length)) & (turning <= R(scene_.max_turning)) &
           (steps <= R(scene_.max_steps));
  }

  /// How far from where it should be a path may be after a straight flight.
  [[nodiscard]] R aside_after(R flight, V place) const {
    const R direction = read(&Lanes::askew) + R(rounding);
    return multiply_add(direction, flight,
                        multiply_add(span(place), R(rounding), read(&Lanes::astray)));
  }

  /// What is written where a step was found to end, or not to be taken; bit i for lane i where
  /// there is an event.
  [[nodiscard]] std::uint32_t tell(R event, R object) const {
    write(&Lanes::event, event);
    write(&Lanes::object, object);
    return bits(event > R(0));
  }

  /// Shows the paths that may meet what boxes hold.
  /// @param share  up to there, 0 where there is nothing to look at
  /// @param rough  where within the step they are not as exact as at its end
  [[nodiscard]] std::uint32_t show(const LanePath<R>& path, R share, Mask rough) const {
    LaneSeen& seen = lanes_.seen;
    share.store(seen.share + first_);
    const auto shown = bits(share > R(0));
    if (shown == 0) return 0;
    const V* c[] = {&path.place.c0, &path.place.c1, &path.place.c2,
                    &path.place.c3, &path.place.c4, &path.place.c5};
    for (int k = 0; k < 6; ++k) {
      c[k]->x.store(seen.cx[k] + first_);
      c[k]->y.store(seen.cy[k] + first_);
      c[k]->z.store(seen.cz[k] + first_);
    }
    path.h.store(seen.h + first_);
    (path.turn / path.h).store(seen.bend + first_);
    select(rough, R(1), R(0)).store(seen.rough + first_);
    read(&Lanes::length).store(seen.length + first_);
    read(&Lanes::turning).store(seen.turning + first_);
    return shown;
  }

  [[nodiscard]] static R code(LaneEvent event) { return R(static_cast<int>(event)); }

 private:
  /// Ten times a float's rounding: the estimates of steps' errors are far above the errors, and
  /// this one is to be so, too.
  static constexpr double rounding = 6e-7;

  [[nodiscard]] R add(LaneRow row, Mask stays, R more) const {
    const R old = read(row);
    const R sum = select(stays, old, old + more);
    write(row, sum);
    return sum;
  }
  /// What the step and the rounding of where it ends add to what a way has drifted.
  void drift(const Move& move, Mask stays) const {
    const Drift<R> before{read(&Lanes::astray), read(&Lanes::askew)};
    Drift<R> after = before;
    after.pass(move.length, move.gradient, move.error + R(rounding));
    const R size = span(move.place);
    write(&Lanes::astray, stays, before.place, multiply_add(size, R(rounding), after.place));
    write(&Lanes::askew, stays, before.direction, after.direction);
  }

  const LaneScene& scene_;
  Lanes& lanes_;
  int first_;
};

}  // namespace portalens
