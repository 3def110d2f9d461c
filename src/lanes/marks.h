/// \file
/// Over lanes: which of many masses are near.
#pragma once

#include <cstdint>

#include "lanes/scene.h"

namespace portalens {

/// A set of masses.
template <class R>
class LaneMarks {
 public:
  /// Empty.
  explicit LaneMarks(int masses) : groups_((masses + 4095) / 4096) {
    for (int g = 0; g < groups_; ++g) used_[g] = 0;
  }
  void add(std::uint32_t mass) {
    const std::uint32_t word = mass / 64, group = word / 64;
    const std::uint64_t bit = std::uint64_t{1} << (word % 64);
    const std::uint64_t old = (used_[group] & bit) != 0 ? words_[word] : 0;
    words_[word] = old | std::uint64_t{1} << (mass % 64);
    used_[group] |= bit;
  }
  /// Calls back with each, ascending.
  template <class Callback>
  void for_each(const Callback& callback) const {
    for (int g = 0; g < groups_; ++g)
      for (std::uint64_t used = used_[g]; used != 0; used &= used - 1) {
        const auto word = static_cast<std::uint32_t>(64 * g + __builtin_ctzll(used));
        for (std::uint64_t rest = words_[word]; rest != 0; rest &= rest - 1)
          callback(64 * word + static_cast<std::uint32_t>(__builtin_ctzll(rest)));
      }
  }

 private:
  int groups_;
  std::uint64_t used_[max_lane_many / 4096];  ///< a bit for each word that holds any
  std::uint64_t words_[max_lane_many / 64];   ///< of no meaning where its bit is not set
};

}  // namespace portalens
