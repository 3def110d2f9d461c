/// \file
/// The back of a portal as a surface.
#pragma once

#include "geometry/ray.h"
#include "portal/portal.h"

namespace portalens {

/// A point of a portal's back. It is a flat face in the portal's own frame: lengths from its first
/// vertex (of a curved one, from the corner of its bounding rectangle), and texture coordinates
/// from 0 to 1 over that rectangle.
[[nodiscard]] SurfacePoint point_on_back(const Portal& portal, Vec3d x);

}  // namespace portalens
