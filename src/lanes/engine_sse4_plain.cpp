#include "lanes/instruction_sets.h"
#include "lanes/step.h"
#include "math/pack.h"

namespace portalens {

std::uint32_t step_lanes_sse4_plain(const LaneScene& scene, Lanes& lanes) {
  return step_lanes<Pair<Pack<xsimd::sse4_2>, Rounding::twice>>(scene, lanes);
}

}  // namespace portalens
