/// \file
/// From where a random scene is looked at.
#pragma once

#include "differential/draft.h"
#include "differential/lot.h"

namespace portalens::differential {

/// Within, at the edge of, and outside of influences, towards something that stands there: a mass,
/// the edge of its influence, a portal, a surface.
/// @param half_box  half of the side of the cube in which things are
void place_camera(Draft& draft, Lot& lot, double half_box);

}  // namespace portalens::differential
