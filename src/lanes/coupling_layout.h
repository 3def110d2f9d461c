/// \file
/// Laying out for the lanes what portals add to gravity.
#pragma once

#include <string>
#include <vector>

#include "gravity/coupling.h"
#include "lanes/plan.h"

namespace portalens {

/// What a coupling says of itself (`lay_out`, gravity/coupling.h), as tables of a plan. Each of
/// these tells why lanes can't hold it; nothing where they can.
/// @pre the plan has its portals and knows its stepped masses
class CouplingLayout {
 public:
  CouplingLayout(const Space& space, LanePlan& plan) : space_(space), plan_(plan) {}

  /// A place that pulls as a mass without a horizon does.
  void mass(Vec3d center, double gm, double core2, double influence);
  /// What is felt at the nearest point of a face (lanes/gates.h).
  std::string nearest_points(const ClosestPointCoupling& coupling);
  /// What a table over a face says (lanes/graviton_map.h).
  std::string maps(const GravitonMapCoupling& coupling);
  /// What pulls along the shortest path through a face (lanes/shortest_path.h).
  std::string shortest_paths(const ShortestPathCoupling& coupling);

  /// Those that act as masses do, of all that was said.
  [[nodiscard]] const std::vector<LaneMass>& masses() const { return masses_; }

 private:
  /// Says which portal is no rectangle; empty where all are.
  [[nodiscard]] std::string odd_portal() const;
  /// Of the cells of a portal's map: `LaneMap::max_nearness`.
  [[nodiscard]] float max_nearness(std::uint32_t portal) const;
  /// `LaneWay::bare2` of a way through one portal.
  [[nodiscard]] float bare2_of_way(const ShortestPathCoupling::Image& image, const Portal& portal);

  const Space& space_;
  LanePlan& plan_;
  std::vector<LaneMass> masses_;
};

/// Light is left to the scalar engine nearer than this many m to a mass that it is bound by through
/// a portal. Within e m it winds in; the field of a point of a face may change much faster than the
/// steps of lanes expect.
inline constexpr double too_near_through = 4.0;

/// Nearer to a mass of that G M, or an image of one, light winds in.
[[nodiscard]] double light_sphere(const Space& space, double gm);

/// Adds a space's coupling to a plan.
/// @param masses  gets what of it acts as masses do
/// @return why lanes can't do it; empty where they can
/// @pre as of a `CouplingLayout`
[[nodiscard]] std::string add_coupling(const Space& space, LanePlan& plan,
                                       std::vector<LaneMass>& masses);

/// The strongest pull that begins, ends or turns at once, length/time²: that of a mass where its
/// influence ends; what comes through a portal where the portal's reach ends, or where it comes
/// along another path.
[[nodiscard]] double strongest_onset(const Space& space);

}  // namespace portalens
