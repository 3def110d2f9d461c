/// \file
/// Laying out for the lanes what portals add to gravity: one table a coupling.
#pragma once

#include <string>
#include <vector>

#include "lanes/plan.h"

namespace portalens {

/// The strongest pull that begins, ends or turns at once, length/time²: that of a mass where its
/// influence ends; what comes through a portal where the portal's reach ends, or where it comes
/// along another way.
[[nodiscard]] double strongest_onset(const Space& space);

/// Adds the portals that act as masses do.
void add_masses_of_portals(const Space& space, Vec3d center, std::vector<LaneMass>& masses);

/// Adds the coupling of a space to a plan that has its masses already.
/// @return why lanes can't do it; empty where they can
/// @pre its portals are there, too
[[nodiscard]] std::string add_coupling(const Space& space, LanePlan& plan);

}  // namespace portalens
