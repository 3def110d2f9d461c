/// \file
/// Gravity ignores portals: `portal_gravity = "none"`.
#pragma once

#include <limits>
#include <string>
#include <string_view>

#include "gravity/coupling_input.h"

namespace portalens {

class NoCoupling {
 public:
  static constexpr std::string_view name = "none";
  static constexpr bool asks_motion = false;
  NoCoupling() = default;
  explicit NoCoupling(const CouplingInput&) {}
  [[nodiscard]] static CouplingCost cost(const CouplingInput&) { return {}; }
  [[nodiscard]] Pull pull(Vec3d, Vec3d) const { return {}; }
  [[nodiscard]] std::uint64_t signature(Vec3d) const { return 0; }
  [[nodiscard]] std::vector<PullPart> parts(Vec3d) const { return {}; }
  template <class Layout>
  [[nodiscard]] std::string lay_out(Layout&) const {
    return "";
  }
  [[nodiscard]] double distance_to_support(Vec3d) const {
    return std::numeric_limits<double>::infinity();
  }
};

}  // namespace portalens
