/// \file
/// The list of couplings: ways in which gravity reaches through portals. equations.md, sec. 5.
///
/// To add one: a header beside this one, and a word in `Coupling`. Each type has
///   static constexpr std::string_view name;               as `physics.portal_gravity` spells it
///   static constexpr bool asks_motion;
///       whether every portal has to be a rigid motion; scenes where one is not are refused
///   explicit T(const CouplingInput&);
///   static CouplingCost cost(const CouplingInput&);
///       an estimate, before it is made
///   Pull pull(Vec3d x, Vec3d anchor) const;
///       what portals add to the acceleration at x (direct attraction is not part of it). Every
///       decision (which side, which edge is nearest, what is in reach) is taken at `anchor`, every
///       value at x: so the field stays smooth over a step whose decisions are frozen.
///   std::uint64_t signature(Vec3d x) const;
///       a hash of all decisions at x: where it changes, the field is not smooth
///   double distance_to_support(Vec3d x) const;
///       a lower bound of the distance from x to where the coupling acts; 0 where it does, infinite
///       if it never does
///   std::vector<PullPart> parts(Vec3d x) const;
///       what `pull(x, x)` is the sum of, one entry a way through portals
/// and is immutable. It may have
///   template <class Layout> std::string lay_out(Layout& layout) const;
///       how lanes hold it: as what `CouplingLayout` in lanes/coupling_layout.h offers; why they
///       can't, or nothing. What has none is left to the scalar engine
///   double distance_to_discontinuity(Vec3d x) const;
///       a lower bound of the distance from x to the nearest place where a part of it begins or
///       ends to act, or of another decision that long steps could overlook when they graze it
/// A coupling that acts infinitely far falls off with the square of the distance, and pulls towards
/// the portals.
#pragma once

#include <string_view>
#include <variant>
#include <vector>

#include "gravity/closest_point_coupling.h"
#include "gravity/coupling_input.h"
#include "gravity/graviton_map_coupling.h"
#include "gravity/no_coupling.h"
#include "gravity/portal_mass_coupling.h"
#include "gravity/shortest_path_coupling.h"

namespace portalens {

using Coupling = std::variant<NoCoupling, ClosestPointCoupling, ShortestPathCoupling,
                              GravitonMapCoupling, PortalMassCoupling>;

/// The names of all couplings, in the order of the list.
[[nodiscard]] std::vector<std::string_view> coupling_names();

/// The coupling with that name.
/// @pre `name` is one of `coupling_names()`
[[nodiscard]] Coupling make_coupling(std::string_view name, const CouplingInput& input);

/// The first portal through which that coupling cannot act; null if it acts through all.
/// @pre `name` is one of `coupling_names()`
[[nodiscard]] const Portal* barred_portal(std::string_view name, std::span<const Portal> portals);

/// What that coupling will cost. Scenes beyond `coupling_budget` are refused before it is made.
/// @pre `name` is one of `coupling_names()`
[[nodiscard]] CouplingCost estimated_cost(std::string_view name, const CouplingInput& input);

}  // namespace portalens
