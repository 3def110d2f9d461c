/// \file
/// The search for the shortest path through several faces.
#pragma once

#include "gravity/shortest_way.h"

namespace portalens {

/// As `shortest_passages`, for any number of faces.
[[nodiscard]] bool search_passages(Vec3d from, Vec3d to, FaceRow faces, double limit, Turns& out);

}  // namespace portalens
