/// \file
/// One photon under way: what stands of its path, and what happens to it.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "photon/curve.h"
#include "photon/drift.h"
#include "photon/obstacles.h"
#include "photon/path_trace.h"
#include "photon/ray_state.h"
#include "photon/space.h"

namespace portalens {

/// Knows no field and no integrator: who moves it on does. Borrows the space.
class Traveller {
 public:
  Traveller(const Traveller&) = delete;
  Traveller& operator=(const Traveller&) = delete;

  /// Takes up a path that was begun elsewhere.
  void resume(const RayState& way) {
    ray_state_ = way;
    free_length_ = 0.0;
    longest_ = unbounded;
    restless_ = true;
  }
  [[nodiscard]] const RayState& way() const { return ray_state_; }
  /// Nothing is met within this much path from where it is.
  [[nodiscard]] double free_length() const { return free_length_; }

  /// Ends a path that has gone too far; whether it has.
  bool gives_up() {
    const Physics& physics = space_.physics;
    const Arrival& arrival = ray_state_.arrival;
    if (arrival.turning > physics.max_turning) return end(Fate::trapped);
    if (arrival.steps >= physics.max_steps || arrival.length > physics.max_length)
      return end(Fate::lost);
    return false;
  }

  /// What happens where the path meets something, at the place where it is; whether it ends there.
  bool encounter(const Encounter& met) {
    Arrival& arrival = ray_state_.arrival;
    if (met.kind == Encounter::Kind::surface || met.kind == Encounter::Kind::portal_back) {
      arrival.met = met.kind == Encounter::Kind::surface ? Met::surface : Met::portal_back;
      arrival.object = met.object;
      arrival.face = met.face;
      return end(Fate::hit);
    }
    if (arrival.crossings >= space_.max_crossings) {
      arrival.out_of_crossings = true;
      return end(Fate::lost);
    }
    ++arrival.crossings;
    const Portal& portal = space_.portals.portals()[met.object];
    arrival.tint = arrival.tint * portal.tint;
    const Passed passed =
        pass(portal.passage, ray_state_.state.position, ray_state_.state.direction);
    ray_state_.state = {passed.position, passed.direction};
    arrival.turning += passed.turning;
    ray_state_.start = {
        space_.leaving_portal(portal.pair, ray_state_.state.position, ray_state_.state.direction)};
    free_length_ = 0.0;
    longest_ = unbounded;
    restless_ = true;
    if (path_trace_) {
      path_trace_->crossings.push_back(met.object);
      path_trace_->stretches.push_back({ray_state_.state.position});
    }
    return false;
  }

  bool absorb(std::uint32_t mass) {
    ray_state_.arrival.met = Met::mass;
    ray_state_.arrival.object = mass;
    return end(Fate::absorbed);
  }

 protected:
  explicit Traveller(const Space& space) : space_(space) {}

  [[nodiscard]] bool has_drifted() const {
    const double trusted = trusted_drift * space_.physics.tolerance;
    return ray_state_.drift.direction > (ray_state_.arrival.fate == Fate::absorbed
                                             ? std::fmax(trusted, absorbed_drift)
                                             : trusted);
  }

  /// A point slightly ahead: what acts there decides what acts over the step.
  [[nodiscard]] Vec3d ahead() const {
    return ray_state_.state.position + ray_state_.state.direction * (1e-9 * space_.extent);
  }

  /// Goes on to the end of a step or a flight.
  void move_on(State to, double distance, double turned) {
    ray_state_.state = to;
    free_length_ = std::fmax(0.0, free_length_ - distance);
    ray_state_.arrival.length += distance;
    ray_state_.arrival.turning += turned + extra_turning_;
    extra_turning_ = 0.0;
    ray_state_.start = ray_state_.start.after(distance);
    restless_ = true;
    if (path_trace_) path_trace_->stretches.back().push_back(ray_state_.state.position);
  }

  void arrive_at(const Curve& curve, double s) {
    move_on({curve.position(s), curve.direction(s)}, s, curve.turning(s));
  }

  bool end(Fate fate) {
    ray_state_.arrival.fate = fate;
    return true;
  }

  static constexpr double unbounded = std::numeric_limits<double>::infinity();

  const Space& space_;
  RayState ray_state_;
  double longest_ = unbounded;  ///< of the next step: what the error of the last allows
  double free_length_ = 0.0;    ///< nothing lies within this much path from here
  double extra_turning_ = 0.0;  ///< of a step with straight pieces: it turns at its start
  bool restless_ = true;        ///< the surroundings have to be looked at again
  PathTrace* path_trace_ = nullptr;
};

}  // namespace portalens
