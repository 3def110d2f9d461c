#include "math/pack.h"
#include "photon/lane_engines.h"
#include "photon/lane_step.h"

namespace portalens {

void step_lanes_sse4(const LaneScene& scene, Lanes& lanes) {
  step_lanes<Pair<Pack<xsimd::sse4_2>>>(scene, lanes);
}

}  // namespace portalens
