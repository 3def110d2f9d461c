/// \file
/// Photons in lanes of one instruction set, and what all sets must agree on.
#pragma once

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

#include "lanes/driver.h"
#include "lanes/instruction_sets.h"
#include "lanes/planned_space.h"

namespace portalens::test {

/// @pre the space has lanes, and this processor the set
inline std::vector<Arrival> in_lanes(const PlannedSpace& space, const std::vector<Photon>& photons,
                                     std::string_view isa) {
  std::vector<Arrival> arrivals(photons.size());
  advance_in_lanes(space, *space.lanes, lane_engine(isa).step, photons, arrivals);
  return arrivals;
}

inline void expect_same(const Arrival& a, const Arrival& b, std::size_t photon) {
  ASSERT_EQ(a.fate, b.fate) << photon;
  ASSERT_EQ(a.object, b.object) << photon;
  ASSERT_EQ(a.position, b.position) << photon;
  ASSERT_EQ(a.direction, b.direction) << photon;
  ASSERT_EQ(a.turning, b.turning) << photon;
  ASSERT_EQ(a.length, b.length) << photon;
  ASSERT_EQ(a.steps, b.steps) << photon;
}

inline void expect_same_bits_with_every_set(const PlannedSpace& space,
                                            const std::vector<Photon>& photons) {
  ASSERT_TRUE(space.lanes);
  const auto expected = in_lanes(space, photons, lane_engine().name);
  for (const char* isa : {"sse4", "avx2", "avx512"}) {
    if (!lane_engine(isa).step) continue;
    const auto arrivals = in_lanes(space, photons, isa);
    for (std::size_t i = 0; i < photons.size(); ++i) expect_same(arrivals[i], expected[i], i);
  }
}

}  // namespace portalens::test
