/// \file
/// The lanes' step for each instruction set, and the choice among them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "lanes/scene.h"

namespace portalens {

std::uint32_t step_lanes_sse4(const LaneScene& scene, Lanes& lanes);
std::uint32_t step_lanes_sse4_plain(const LaneScene& scene, Lanes& lanes);
std::uint32_t step_lanes_avx2(const LaneScene& scene, Lanes& lanes);
std::uint32_t step_lanes_avx512(const LaneScene& scene, Lanes& lanes);

struct LaneEngine {
  std::string_view name;
  LaneStep step;              ///< null where the processor has no such instructions
  bool rounds_as_all = true;  ///< gives the same bits as all others that do
};

/// The fastest that the processor has, or the one that PORTALENS_ISA names (sse4, sse4-plain, avx2,
/// avx512). Processors without an instruction for a b + c take `sse4-plain`, which rounds that
/// twice; `sse4` rounds it once by way of doubles, as exactly as the wider ones, and takes several
/// times as long.
[[nodiscard]] LaneEngine lane_engine();
/// The one with that name; `step` is null if there is none or the processor lacks it.
[[nodiscard]] LaneEngine lane_engine(std::string_view name);
/// Why `lane_engine()` has no step. No capital letter, no full stop.
[[nodiscard]] std::string why_no_lane_engine();

}  // namespace portalens
