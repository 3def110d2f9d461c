/// \file
/// The paths of lanes' photons, written down as they go, where anybody asks for them.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>

#include "lanes/log.h"
#include "lanes/plan.h"
#include "lanes/states.h"
#include "photon/path_record.h"
#include "photon/space.h"

namespace portalens {

/// Does nothing for a photon that has no record.
class LaneRecorder {
 public:
  /// @param photons  of each lane
  /// @param records  of the first photons
  LaneRecorder(const Space& space, const LanePlan& plan, const LaneStates& states,
               const std::array<std::size_t, lane_count>& photons, std::span<PathRecord> records)
      : space_(space),
        plan_(plan),
        states_(states),
        photons_(photons),
        records_(records),
        log_(plan.center) {}

  void begin(int lane, Vec3d start) {
    if (!is_told(lane)) return;
    record(lane).restart();
    record(lane).pass(start, 0.0, 0.0);
  }
  void lose_track(int lane) {
    if (is_told(lane)) record(lane).lose_track();
  }
  void cross(int lane, std::uint32_t portal) {
    if (is_told(lane)) record(lane).cross(portal);
  }

  /// Where the lanes are that a step has moved. How it was for those with an event, is told by
  /// other members.
  void pass(std::uint32_t events) {
    if (records_.empty()) return;
    const Lanes& lanes = states_.rows();
    log_.note(lanes);
    for (; events != 0; events &= events - 1) {
      const int lane = std::countr_zero(events);
      if (is_told(lane)) log_.tell(lane, record(lane), 1);
    }
    if (!log_.full()) return;
    for (int lane = 0; lane < lane_count; ++lane)
      if (lanes.live[lane] > 0.0f && is_told(lane)) log_.tell(lane, record(lane), 0);
    log_.clear();
  }
  /// Where the lane is after its step.
  void pass_lane(int lane) {
    if (!is_told(lane)) return;
    const Lanes& lanes = states_.rows();
    record(lane).pass(states_.state_of(lane).position, lanes.length[lane], lanes.turning[lane]);
  }
  /// A place on the lane's path, at the length that the arrival tells.
  void pass_place(int lane, Vec3d place, const Arrival& arrival) {
    if (is_told(lane)) record(lane).pass(place, arrival.length, arrival.turning);
  }
  /// Its way through the influence of an isolated mass, which it has just left or ended in.
  void pass_isolated(int lane) {
    if (!is_told(lane)) return;
    const Lanes& lanes = states_.rows();
    const auto object = static_cast<std::uint32_t>(lanes.object[lane]);
    const IsolatedMass& isolated = plan_.isolated.masses[object - first_isolated_object];
    note_crossing(space_.masses[isolated.mass], plan_.isolated.tables[isolated.table],
                  states_.state_of(lane), lanes.length[lane], lanes.turning[lane], record(lane));
  }
  /// Where the path ends; one to the sky, as far as there is anything.
  void end(int lane, const Arrival& arrival) {
    pass_place(lane, arrival.position, arrival);
    if (!is_told(lane) || arrival.fate != Fate::escaped) return;
    const double rest = length(arrival.position - plan_.center) + plan_.scene.radius;
    record(lane).pass(arrival.position + arrival.direction * rest, arrival.length + rest,
                      arrival.turning);
  }

 private:
  [[nodiscard]] bool is_told(int lane) const { return photons_[lane] < records_.size(); }
  [[nodiscard]] PathRecord& record(int lane) const { return records_[photons_[lane]]; }

  const Space& space_;
  const LanePlan& plan_;
  const LaneStates& states_;
  const std::array<std::size_t, lane_count>& photons_;
  std::span<PathRecord> records_;
  LaneLog log_;  ///< of what is not in the path records yet
};

}  // namespace portalens
