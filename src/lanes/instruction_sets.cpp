#include "lanes/instruction_sets.h"

#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/words.h"

namespace portalens {
namespace {

/// From the slowest to the fastest. Other processors than Intel's kind have none, and some builds
/// leave some out (PORTALENS_INSTRUCTION_SETS in CMakeLists.txt).
std::array<LaneEngine, 4> engines() {
  std::array<LaneEngine, 4> all{
      {{"sse4", nullptr}, {"sse4-plain", nullptr, false}, {"avx2", nullptr}, {"avx512", nullptr}}};
#ifdef __x86_64__
  __builtin_cpu_init();
#ifdef PORTALENS_LANES_SSE4
  if (__builtin_cpu_supports("sse4.2")) {
    all[0].step = step_lanes_sse4;
    all[1].step = step_lanes_sse4_plain;
  }
#endif
#ifdef PORTALENS_LANES_AVX2
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    all[2].step = step_lanes_avx2;
#endif
#ifdef PORTALENS_LANES_AVX512
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw"))
    all[3].step = step_lanes_avx512;
#endif
#endif
  return all;
}

}  // namespace

LaneEngine lane_engine(std::string_view name) {
  for (const LaneEngine& engine : engines())
    if (engine.name == name) return engine;
  return {"", nullptr};
}

LaneEngine lane_engine() {
  if (const char* forced = std::getenv("PORTALENS_ISA")) return lane_engine(forced);
  LaneEngine fastest{"", nullptr};
  for (const LaneEngine& engine : engines())
    if (engine.step) fastest = engine;
  return fastest;
}

std::string why_no_lane_engine() {
  std::vector<std::string> had;
  for (const LaneEngine& engine : engines())
    if (engine.step) had.emplace_back(engine.name);
  const char* forced = std::getenv("PORTALENS_ISA");
  if (forced && !had.empty())
    return fmt::format("PORTALENS_ISA asks for {}, which this processor or program lacks ({})",
                       in_quotes(forced), suggestion_or_list(forced, had));
  return "this processor or program lacks the instructions that lanes need (SSE 4.2)";
}

}  // namespace portalens
