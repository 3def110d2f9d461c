/// \file
/// Laying out for the lanes what portals add to gravity.
#pragma once

#include <string>
#include <vector>

#include "gravity/coupling.h"
#include "lanes/plan.h"

namespace portalens {

/// What a coupling's `lay_out` (gravity/coupling.h) is given: it writes the coupling into the plan
/// of the lanes. A function that returns text says why lanes can't represent the coupling; the text
/// is empty where they can.
/// @pre the plan's portals are filled in, and the masses that lanes step through are chosen
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

  /// Those that were added with `mass`.
  [[nodiscard]] const std::vector<LaneMass>& masses() const { return masses_; }

 private:
  /// Of the cells of a portal's map: `LaneMap::max_nearness`.
  [[nodiscard]] float max_nearness(std::uint32_t portal) const;
  /// `LaneWay::bare2` of a way through one portal.
  [[nodiscard]] float bare2_of_way(const ShortestPathCoupling::Image& image, const Portal& portal);

  const Space& space_;
  LanePlan& plan_;
  std::vector<LaneMass> masses_;
};

/// In units of G M / c² of a mass that can bind light through a portal: paths that come nearer to
/// it than that are left to the scalar engine. Newton's pull binds light nearer than e = 2.718 of
/// them, and the field of a face's nearest point may change there much faster than lanes' steps
/// allow for.
inline constexpr double too_near_through = 4.0;

/// The radius at which light circles a mass of that G M, or its image behind a portal: nearer to it
/// light spirals inwards.
[[nodiscard]] double light_sphere(const Space& space, double gm);

/// Adds a space's coupling to a plan.
/// @param masses  gets what of it acts as masses do
/// @return why lanes can't do it; empty where they can
/// @pre as of a `CouplingLayout`
[[nodiscard]] std::string add_coupling(const Space& space, LanePlan& plan,
                                       std::vector<LaneMass>& masses);

/// The largest jump of the field anywhere, length/time²: a mass's pull where its influence ends, or
/// a pull through a portal where the portal's reach ends, or where the shortest path changes.
[[nodiscard]] double strongest_onset(const Space& space);

}  // namespace portalens
