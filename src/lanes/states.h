/// \file
/// What the lanes hold, photon by photon: in floats for the steps, and in double where a photon was
/// put.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "lanes/border.h"
#include "lanes/plan.h"
#include "photon/ray_state.h"
#include "photon/space.h"

namespace portalens {

class LaneStates {
 public:
  LaneStates(const Space& space, const LanePlan& plan) : space_(space), plan_(plan) {}

  [[nodiscard]] Lanes& rows() { return lanes_; }
  [[nodiscard]] const Lanes& rows() const { return lanes_; }

  /// Whether the lane's photon has gone all its path from its start in lanes.
  [[nodiscard]] bool is_whole(int lane) const { return (whole_ >> lane & 1) != 0; }
  /// Which `lane_strictness` its steps are judged by.
  [[nodiscard]] int strictness(int lane) const { return strictness_[lane]; }
  /// The lanes that have not moved since they were filled, a bit each; from now on none of them is
  /// known as such.
  [[nodiscard]] std::uint32_t take_fresh() { return std::exchange(fresh_, 0); }

  /// Asked of the floats: their sum is no number where one of them is none.
  [[nodiscard]] bool is_number(int lane) const {
    return std::isfinite(lanes_.x[lane] + lanes_.y[lane] + lanes_.z[lane] + lanes_.tx[lane] +
                         lanes_.ty[lane] + lanes_.tz[lane]);
  }

  /// Where the lane is.
  [[nodiscard]] State state_of(int lane) const {
    const Vec3d t{lanes_.tx[lane], lanes_.ty[lane], lanes_.tz[lane]};
    // Of length 1 but for a float's rounding: one step of Newton's method leaves nothing of that.
    return {plan_.center + Vec3d{lanes_.x[lane], lanes_.y[lane], lanes_.z[lane]},
            t * (1.5 - 0.5 * dot(t, t))};
  }

  /// Where the path begins that is seen.
  [[nodiscard]] State seen_from(int lane) const {
    const LaneSeen& seen = lanes_.seen;
    const Vec3d t = Vec3d{seen.cx[1][lane], seen.cy[1][lane], seen.cz[1][lane]};
    return {plan_.center + Vec3d{seen.cx[0][lane], seen.cy[0][lane], seen.cz[0][lane]},
            normalize(t)};
  }
  /// Where the lane's photon was put.
  /// @param photon  the lane's
  [[nodiscard]] State put_state(int lane, const Photon& photon) const {
    if (!is_whole(lane)) return states_[lane];
    return {photon.position, photon.direction};
  }
  /// From where its path is followed: what it has left.
  /// @param photon  the lane's
  [[nodiscard]] PathStart start_of(int lane, const Photon& photon) const {
    return is_whole(lane) ? PathStart{photon.guard} : starts_[lane];
  }

  /// Puts a photon at its start.
  /// @param strictness  which `lane_strictness`
  void begin(int lane, const Photon& photon, int strictness) {
    whole_ |= std::uint32_t{1} << lane;
    put(lane, {photon.position, photon.direction}, photon.guard, 0.0);
    lanes_.length[lane] = lanes_.turning[lane] = lanes_.steps[lane] = 0.0f;
    lanes_.astray[lane] = lanes_.askew[lane] = 0.0f;
    strictness_[lane] = strictness;
    lanes_.judged[lane] = lane_strictness[strictness].judged;
    lanes_.shorter[lane] = lane_strictness[strictness].shorter;
  }

  /// The lane's photon goes on from there; how far it has come, its arrival tells.
  void put_back(int lane, const RayState& ray, double clear) {
    whole_ &= ~(std::uint32_t{1} << lane);
    states_[lane] = ray.state;
    starts_[lane] = ray.start;
    put(lane, ray.state, ray.start.guard, clear);
    lanes_.length[lane] = static_cast<float>(ray.arrival.length);
    lanes_.turning[lane] = static_cast<float>(ray.arrival.turning);
    lanes_.steps[lane] = static_cast<float>(ray.arrival.steps);
    lanes_.astray[lane] = static_cast<float>(ray.drift.place);
    lanes_.askew[lane] = static_cast<float>(ray.drift.direction);
  }

  /// Makes it hold something harmless.
  void rest(int lane) {
    lanes_.x[lane] = lanes_.y[lane] = lanes_.z[lane] = static_cast<float>(space_.extent);
    lanes_.tx[lane] = 1.0f;
    lanes_.ty[lane] = lanes_.tz[lane] = 0.0f;
    lanes_.length[lane] = lanes_.turning[lane] = lanes_.steps[lane] = 0.0f;
    lanes_.departed[lane] = -1.0f;
    lanes_.departed_side[lane] = 1.0f;
    lanes_.clear[lane] = 0.0f;
    lanes_.longest[lane] = never;
    lanes_.astray[lane] = lanes_.askew[lane] = 0.0f;
    lanes_.judged[lane] = lanes_.shorter[lane] = 1.0f;
    lanes_.live[lane] = 0.0f;
  }

 private:
  /// @param clear  nothing is met within that much path
  void put(int lane, const State& state, const SelfIntersectionGuard& guard, double clear) {
    fresh_ |= std::uint32_t{1} << lane;
    const Vec3d x = state.position - plan_.center;
    lanes_.x[lane] = static_cast<float>(x.x);
    lanes_.y[lane] = static_cast<float>(x.y);
    lanes_.z[lane] = static_cast<float>(x.z);
    lanes_.tx[lane] = static_cast<float>(state.direction.x);
    lanes_.ty[lane] = static_cast<float>(state.direction.y);
    lanes_.tz[lane] = static_cast<float>(state.direction.z);
    lanes_.departed[lane] = -1.0f;
    lanes_.departed_side[lane] = static_cast<float>(guard.side);
    if (guard.shape != no_object) {
      lanes_.departed[lane] = static_cast<float>(guard.shape);
      const LeftPlane left = space_.surfaces.flush().left_by(guard);
      if (left.plane != LeftPlane::none) {
        lanes_.departed[lane] = LanePlan::departed_from(left.plane);
        lanes_.departed_side[lane] = static_cast<float>(left.side);
      }
    }
    lanes_.clear[lane] = static_cast<float>(clear);
    lanes_.longest[lane] = never;
    lanes_.live[lane] = 1.0f;
  }

  const Space& space_;
  const LanePlan& plan_;
  Lanes lanes_;
  // Where they were put, in double; of those whose whole path is in lanes, the photon tells.
  std::array<State, lane_count> states_;
  std::array<PathStart, lane_count> starts_;
  std::array<int, lane_count> strictness_{};
  std::uint32_t whole_ = 0, fresh_ = 0;  ///< a bit each
};

}  // namespace portalens
