#include "lanes/instruction_sets.h"

#include <array>
#include <cstdlib>

namespace portalens {
namespace {

/// From the narrowest to the widest. Other processors than Intel's kind have none.
std::array<LaneEngine, 3> engines() {
#ifdef __x86_64__
  __builtin_cpu_init();
  const bool sse4 = __builtin_cpu_supports("sse4.2");
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  const bool avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
  return {{{"sse4", sse4 ? step_lanes_sse4 : nullptr},
           {"avx2", avx2 ? step_lanes_avx2 : nullptr},
           {"avx512", avx512 ? step_lanes_avx512 : nullptr}}};
#else
  return {{{"sse4", nullptr}, {"avx2", nullptr}, {"avx512", nullptr}}};
#endif
}

}  // namespace

LaneEngine lane_engine(std::string_view name) {
  for (const LaneEngine& engine : engines())
    if (engine.name == name) return engine;
  return {"", nullptr};
}

LaneEngine lane_engine() {
  if (const char* forced = std::getenv("PORTALENS_ISA")) return lane_engine(forced);
  LaneEngine widest{"", nullptr};
  for (const LaneEngine& engine : engines())
    if (engine.step) widest = engine;
  return widest;
}

}  // namespace portalens
