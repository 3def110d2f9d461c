/// \file
/// Where the lanes were after each of their last steps. To put all of them down at once and sort
/// them by lane when a path is asked for takes less than to continue a path record a lane and step.
#pragma once

#include <algorithm>
#include <array>

#include "lanes/scene.h"
#include "math/vec3.h"
#include "photon/path_record.h"

namespace portalens {

class LaneLog {
 public:
  explicit LaneLog(Vec3d center) : center_(center) {}

  [[nodiscard]] bool full() const { return count_ == max_steps; }
  /// All lanes as a step has left them. @pre not full
  void note(const Lanes& lanes) {
    Step& step = steps_[count_++];
    std::copy_n(lanes.x, lane_count, step.x);
    std::copy_n(lanes.y, lane_count, step.y);
    std::copy_n(lanes.z, lane_count, step.z);
    std::copy_n(lanes.length, lane_count, step.length);
    std::copy_n(lanes.turning, lane_count, step.turning);
  }
  /// Adds the lane's places to the path record, but for as many of the last steps; they are told
  /// once.
  void tell(int lane, PathRecord& record, int but) {
    for (int i = begun_[lane]; i < count_ - but; ++i) {
      const Step& step = steps_[i];
      record.pass(center_ + Vec3d{step.x[lane], step.y[lane], step.z[lane]}, step.length[lane],
                  step.turning[lane]);
    }
    begun_[lane] = count_;
  }
  /// @pre all lanes whose path is asked for have been told
  void clear() {
    count_ = 0;
    begun_ = {};
  }

 private:
  static constexpr int max_steps = 64;
  struct alignas(64) Step {
    float x[lane_count], y[lane_count], z[lane_count], length[lane_count], turning[lane_count];
  };

  Vec3d center_;
  int count_ = 0;
  std::array<int, lane_count> begun_{};
  std::array<Step, max_steps> steps_;
};

}  // namespace portalens
