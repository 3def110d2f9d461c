/// \file
/// The path of one photon, from its start to its fate: equations.md, sec. 1 and 6.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "gravity/field.h"
#include "gravity/influence.h"
#include "photon/change_finder.h"
#include "photon/curve.h"
#include "photon/flight.h"
#include "photon/horizons.h"
#include "photon/last_pull.h"
#include "photon/obstacles.h"
#include "photon/path_trace.h"
#include "photon/ray_state.h"
#include "photon/traveller.h"
#include "photon/vicinity.h"

namespace portalens {

/// Advances photons one after the other in double: the oracle that every other engine is held
/// against. Borrows the space; the scratch it keeps makes it one thread's own.
/// @tparam W  the `Weighing` of the law
template <class I, class C, class W>
class Tracer : public Traveller {
 public:
  Tracer(const Space& space, const I& integrator, const C& coupling, W)
      : Traveller(space),
        tolerance_(space.physics.tolerance),
        integrator_(integrator),
        field_(space.masses, space.mass_tree, coupling, space.physics.c,
               space.medium.uniform_weight()),
        vicinity_(space.mass_tree),
        changes_(space, field_, vicinity_, surroundings_),
        obstacles_(space.surfaces, space.portals),
        gates_(middle_of_portals(space)) {}

  [[nodiscard]] Arrival advance(const Photon& photon, PathTrace* path_trace) {
    follow(photon, path_trace);
    const Arrival found = ray_state_.arrived();
    if constexpr (!I::fixed_step)
      if (has_drifted()) return advance_finer(photon, path_trace, found, 1e-1);
    return found;
  }

  /// Follows a photon that drifted too far again, at smaller and smaller tolerances: near capture,
  /// and where it is led through portals many times, a path magnifies every error made on it.
  /// Until one drifts no more, or two in a row end alike.
  /// @param found     the arrival of coarser steps
  /// @param at_first  the share of the tolerance to begin with
  [[nodiscard]] Arrival advance_finer(const Photon& photon, PathTrace* path_trace, Arrival found,
                                      double at_first) {
    const Physics& physics = space_.physics;
    const I usual = integrator_;
    for (const double share : {1e-1, 1e-2, 1e-4}) {
      if (share > at_first) continue;
      tolerance_ = share * physics.tolerance;
      integrator_ = I::from({physics.step, tolerance_});
      follow(photon, path_trace);
      if (ray_state_.arrival.steps >= physics.max_steps) break;
      const Arrival before = std::exchange(found, ray_state_.arrived());
      if (!has_drifted() || end_alike(before, found, physics.tolerance) || tolerance_ < finest)
        break;
    }
    tolerance_ = physics.tolerance;
    integrator_ = usual;
    return found;
  }

  /// One flight or step; whether the photon has arrived.
  bool one_step() {
    Arrival& arrival = ray_state_.arrival;
    if (!is_finite(ray_state_.state.position) || !is_finite(ray_state_.state.direction))
      return end(Fate::lost);
    vicinity_.cover(ray_state_.state.position, 0.0);
    if (const auto mass = horizon_around(space_, vicinity_.near(), ray_state_.state.position))
      return absorb(*mass);
    if (gives_up()) return true;
    ++arrival.steps;

    if (restless_) {
      const Vec3d anchor = ahead();
      vicinity_.cover(anchor, 0.0);
      field_.surround(anchor, vicinity_.near(), surroundings_);
      if (surroundings_.silent()) return fly();
      bending_ =
          field_.bending(ray_state_.state.position, ray_state_.state.direction, surroundings_);
      restless_ = false;
    }
    if (far_from_all()) return true;
    return step();
  }

 private:
  void follow(const Photon& photon, PathTrace* path_trace) {
    path_trace_ = path_trace;
    if (path_trace_) *path_trace_ = PathTrace();
    resume(RayState::of(photon));
    if (path_trace_) path_trace_->stretches.back().push_back(ray_state_.state.position);
    while (!one_step()) {
    }
    if (path_trace_) path_trace_->stretches.back().push_back(ray_state_.state.position);
  }

  /// Straight flight, outside all influence.
  bool fly() {
    longest_ = unbounded;
    const Ray ray{ray_state_.state.position, ray_state_.state.direction};
    const double reach = reach_of_flight(space_, field_, vicinity_, ray);
    std::optional<Encounter> met = obstacles_.first(ray, reach, ray_state_.start);
    double distance = met ? met->distance : reach;
    std::optional<std::uint32_t> swallowed;
    // Most horizons lie deep within an influence, where the flight ends.
    for (const std::uint32_t i : space_.mass_tree.bare_horizons()) {
      const Mass& mass = space_.masses[i];
      const double at = entry_into(mass.center, mass.horizon_radius, ray);
      if (at <= distance && std::isfinite(at)) distance = at, swallowed = i;
    }
    if (std::isinf(distance)) return end(Fate::escaped);
    ray_state_.drift.pass(distance, 0.0, 0.0);
    move_on({ray.at(distance), ray.direction}, distance, 0.0);
    if (swallowed) return absorb(*swallowed);
    if (met) return encounter(*met);
    return false;
  }

  /// One step of the integrator, cut where something happens.
  bool step() {
    double h = proposed_length();
    Curve curve = try_step(h);
    bool rough = false;
    if constexpr (!I::fixed_step) {
      double roughness = roughness_of(h);
      while (roughness > I::roughest && h > shortest()) {
        h = std::fmax(I::longest_after(h, roughness, unbounded), shortest());
        curve = try_step(h);
        roughness = roughness_of(h);
      }
      longest_ = I::longest_after(h, roughness, unbounded);
      const auto change = changes_.first_on(curve, margin());
      changed_ = change.has_value();
      if (changed_ && *change < h) {
        h = *change;
        curve = try_step(h);
        roughness = roughness_of(h);
      }
      ray_state_.drift.pass(h, drift_gradient(), tolerance_ * roughness);
      rough = roughness > I::smooth;
    }
    // Where a pull has no bound. Nothing is met on a path that is no number.
    if (!is_finite(end_.position) || !is_finite(end_.direction)) return end(Fate::lost);
    const auto swallowed = first_horizon(space_, vicinity_.near(), curve);
    const double limit = swallowed ? swallowed->distance : std::numeric_limits<double>::infinity();
    const auto met = obstacle_on(curve);
    if (swallowed && (!met || limit <= met->distance)) {
      arrive_at(curve, limit);
      return absorb(swallowed->mass);
    }
    if (met) {
      // Within a step a path is not as exact as at its end: where that counts, it is gone again.
      const bool again = rough && met->distance < h;
      if (again) (void)try_step(met->distance);
      arrive_at(curve, met->distance);
      if (again) ray_state_.state.direction = end_.direction;
      return encounter(*met);
    }
    move_on(end_, h, curve.turning(h));
    bending_ = end_bending_;
    restless_ = I::fixed_step || changed_ || bending_.nearness == 0.0;
    return false;
  }

  /// By which errors grow.
  [[nodiscard]] double drift_gradient() const {
    if constexpr (!W::uniform)
      if (bending_.sinking > 0.0) return 0.0;
    return bending_.shear;
  }

  /// Of the step that was tried last.
  [[nodiscard]] double roughness_of(double h) const {
    const double pull2 = dot(bending_.acceleration, bending_.acceleration);
    return integrator_.roughness(doubt_, pull2, bending_.gradient, h);
  }

  [[nodiscard]] double proposed_length() {
    const double longest = 2.0 * space_.extent + space_.physics.max_length;
    double h;
    if constexpr (I::fixed_step) {
      h = integrator_.length;
    } else {
      h = integrator_.propose(bending_.stiffness, bending_.nearness);
      // Within reach of a portal whose surroundings do not pull: nothing to choose a step from.
      if (bending_.nearness == 0.0) h = space_.extent / 64.0;
      h = std::fmin(h, longest_);
    }
    // With half a length to spare: the step's polynomial may leave the ball of radius h.
    vicinity_.cover(ray_state_.state.position, 1.5 * std::fmin(h, longest));
    if constexpr (!I::fixed_step) h = std::fmin(h, straight_exit());
    return std::fmin(std::fmax(h, shortest()), longest);
  }

  /// Of a step: rounding makes shorter ones pointless.
  [[nodiscard]] double shortest() const { return 1e-9 * space_.extent; }

  /// The distance along the path's parabola to the nearest boundary of an influence, if it is near.
  [[nodiscard]] double straight_exit() const {
    double least = std::numeric_limits<double>::infinity();
    const Ray ray{ray_state_.state.position, ray_state_.state.direction};
    const Vec3d bend = turning_part(bending_.acceleration, ray.direction);
    for (const std::uint32_t i : vicinity_.near()) {
      const Mass& mass = space_.masses[i];
      if (std::isinf(mass.influence)) continue;
      double at = entry_into(mass.center, mass.influence, ray);
      if (at == 0.0) at = exit_from(mass.center, mass.influence, ray, bend);
      least = std::fmin(least, at);
    }
    return least + margin();
  }

  /// Boundaries are found to within this length: what a misplaced jump of the field can turn is a
  /// small share of the tolerance.
  [[nodiscard]] double margin() const {
    const double bend = length(bending_.acceleration);
    const double share = 0.02 * tolerance_;
    return std::fmax(
        1e-11 * space_.extent,
        std::fmin(bend > 0.0 ? share / bend : share * space_.extent, share * space_.extent));
  }

  [[nodiscard]] Curve try_step(double h) {
    const auto acceleration = [this](Vec3d x) {
      return field_.bending(x, ray_state_.state.direction, surroundings_).acceleration;
    };
    const StepResult<double> result =
        I::step(acceleration, ray_state_.state, bending_.acceleration, h);
    end_ = result.end;
    doubt_ = result.doubt;
    if constexpr (I::straight_pieces) {
      const double turned = angle(ray_state_.state.direction, end_.direction);
      extra_turning_ = turned;
      return Curve(ray_state_.state.position, end_.direction, h);
    } else {
      end_bending_ = field_.bending(end_.position, end_.direction, surroundings_);
      return Curve(ray_state_.state.position, ray_state_.state.direction,
                   turning_part(bending_.acceleration, ray_state_.state.direction), end_.position,
                   end_.direction, turning_part(end_bending_.acceleration, end_.direction),
                   result.middle_bend, h);
    }
  }

  [[nodiscard]] static double angle(Vec3d a, Vec3d b) {
    return std::atan2(length(cross(a, b)), dot(a, b));
  }

  [[nodiscard]] std::optional<Encounter> obstacle_on(const Curve& curve) {
    const double h = curve.length();
    if (free_length_ < h) free_length_ = obstacles_.clearance(ray_state_.state.position, 8.0 * h);
    if (free_length_ >= h) return std::nullopt;
    const double flatness = 0.5 * tolerance_ * (ray_state_.arrival.length + h);
    const double free = std::exchange(free_length_, 0.0);
    return obstacles_.first(curve, free, flatness, ray_state_.start);
  }

  /// Outside everything but infinite influences, on a straight path that meets nothing, with less
  /// turning to come than the tolerance: what is to come is added (to first order in m/d, so the
  /// error is a share m/d of it), and the photon has escaped.
  [[nodiscard]] bool far_from_all() {
    if (!space_.unbounded) return false;
    const Vec3d through = field_.through_portals(ray_state_.state.position, surroundings_);
    const auto rest = last_pull(space_, ray_state_.state, surroundings_, through, gates_);
    if (!rest || rest->turning > tolerance_ || rest->turning * rest->closeness > 0.02 * tolerance_)
      return false;
    const Ray ray{ray_state_.state.position, ray_state_.state.direction};
    const double reach = field_.free_flight(ray, 1e-7 * space_.extent, 1e3 * space_.extent);
    if (reach > 0.0 && std::isfinite(reach)) return false;
    if (obstacles_.first(ray, std::numeric_limits<double>::infinity(), ray_state_.start))
      return false;
    ray_state_.state.direction = normalize(ray_state_.state.direction + rest->kick);
    ray_state_.arrival.turning += rest->turning;
    return end(Fate::escaped);
  }

  static constexpr double finest = 1e-9;  ///< of tolerances: doubles keep hardly any finer one

  double tolerance_;  ///< that of the scene, or a finer one
  I integrator_;
  Field<C, W> field_;
  Vicinity vicinity_;
  Surroundings surroundings_;
  ChangeFinder<C, W> changes_;
  Obstacles obstacles_;
  Vec3d gates_;  ///< the middle of all portals

  State end_;
  Bending bending_, end_bending_;
  StepDoubt<double> doubt_;  ///< of the step that was tried last
  bool changed_ = false;     ///< the step ends where the surroundings change
};

}  // namespace portalens
