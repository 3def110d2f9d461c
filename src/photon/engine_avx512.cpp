#include "math/pack.h"
#include "photon/lane_engines.h"
#include "photon/lane_step.h"

namespace portalens {

void step_lanes_avx512(const LaneScene& scene, Lanes& lanes) {
  step_lanes<Pair<Pack<xsimd::avx512bw>>>(scene, lanes);
}

}  // namespace portalens
