#include "lanes/instruction_sets.h"
#include "lanes/step.h"
#include "math/pack.h"

namespace portalens {

std::uint32_t step_lanes_avx2(const LaneScene& scene, Lanes& lanes) {
  return step_lanes<Pair<Pack<xsimd::fma3<xsimd::avx2>>>>(scene, lanes);
}

}  // namespace portalens
