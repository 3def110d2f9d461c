/// \file
/// `closest-point`: each portal pulls as its pair's surroundings pull the point of the face that is
/// nearest. Dunigan & Pianta, sec. 6; equations.md, sec. 5.
///
///     g_k(x) = g0(x) + Σ_A R_A⁻¹ g_{k-1}(T_A q_A(x))     over A with |x - q_A(x)| < reach_A(k)
///
/// where the recursion leaves out A's pair, and q_A(x) is the point of A's face closest to x: from
/// in front of its plane that of the polygon, from behind that of the rim.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "gravity/coupling_input.h"
#include "gravity/portal_face.h"

namespace portalens {

class ClosestPointCoupling {
 public:
  static constexpr std::string_view name = "closest-point";
  static constexpr bool asks_motion = true;

  /// @pre depth >= 0; some reach is infinite if a mass's influence is, and then
  /// `distance_to_support` is 0.
  explicit ClosestPointCoupling(const CouplingInput& input);
  [[nodiscard]] static CouplingCost cost(const CouplingInput& input);

  [[nodiscard]] Pull pull(Vec3d x, Vec3d anchor) const {
    return through_portals(x, anchor, depth_, no_portal);
  }
  [[nodiscard]] std::uint64_t signature(Vec3d x) const {
    return decisions(x, depth_, no_portal, 0);
  }
  template <class Layout>
  [[nodiscard]] std::string lay_out(Layout& layout) const {
    return layout.nearest_points(*this);
  }
  [[nodiscard]] double distance_to_support(Vec3d x) const;
  /// Of the reaches of all portals, and of the influences behind them.
  [[nodiscard]] double distance_to_discontinuity(Vec3d x) const {
    return distance_to_discontinuity(x, depth_, no_portal);
  }
  /// One part a chain of portals: all masses directly, as seen from the last of them. `places` are
  /// the nearest points, each on its own portal; `beyond` is the last, moved through; `distance`
  /// is the sum of |x - q|.
  [[nodiscard]] std::vector<PullPart> parts(Vec3d x) const;

  /// R_A⁻¹ g_{k-1}(T_A q): what portal A passes on from its pair's surroundings, at full depth.
  /// @param q, q_anchor  points of A's plane
  /// @pre depth > 0
  [[nodiscard]] Pull passed_on(std::uint32_t portal, Vec3d q, Vec3d q_anchor) const {
    return passed_on(portal, q, q_anchor, depth_);
  }
  /// reach_A at full depth; 0 if the portal never acts.
  [[nodiscard]] double reach(std::uint32_t portal) const { return reach(portal, depth_); }
  /// reach_A(k), k <= depth.
  [[nodiscard]] double reach(std::uint32_t portal, int depth) const {
    return reach_[static_cast<std::size_t>(depth) * gates_.size() + portal];
  }
  [[nodiscard]] const PortalFace& face(std::uint32_t portal) const { return gates_[portal].face; }
  [[nodiscard]] const Rigid& through(std::uint32_t portal) const { return gates_[portal].through; }
  [[nodiscard]] std::uint32_t portal_count() const {
    return static_cast<std::uint32_t>(gates_.size());
  }
  [[nodiscard]] int depth() const { return depth_; }

 private:
  static constexpr std::uint32_t no_portal = 0xffffffff;
  struct Gate {
    PortalFace face;
    Rigid through;
    std::uint32_t pair;
  };
  struct Source {
    Vec3d center;
    double gm, core2, influence2;
  };

  void compute_reaches();
  [[nodiscard]] Pull through_portals(Vec3d x, Vec3d anchor, int depth,
                                     std::uint32_t left_out) const;
  [[nodiscard]] Pull passed_on(std::uint32_t portal, Vec3d q, Vec3d q_anchor, int depth) const;
  [[nodiscard]] Pull direct(Vec3d x, Vec3d anchor) const;
  /// Adds the paths from x, which lies beyond the portals that `before` has passed.
  void add_parts(Vec3d x, int depth, std::uint32_t left_out, const PullPart& before,
                 std::vector<PullPart>& parts) const;
  [[nodiscard]] double distance_to_discontinuity(Vec3d x, int depth, std::uint32_t left_out) const;
  [[nodiscard]] std::uint64_t decisions(Vec3d x, int depth, std::uint32_t left_out,
                                        std::uint64_t path) const;

  std::vector<Gate> gates_;
  std::vector<Source> sources_;
  std::vector<double> reach_;  ///< [depth][portal]
  int depth_;
};

}  // namespace portalens
