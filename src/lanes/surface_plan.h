/// \file
/// Laying out for the lanes what surfaces a space has.
#pragma once

#include "lanes/plan.h"

namespace portalens {

/// Adds the shapes of a space, and where faces lie so close behind each other that the scalar
/// engine has to look.
/// @pre the plan has its portals
void add_surfaces(const Space& space, LanePlan& plan);

}  // namespace portalens
