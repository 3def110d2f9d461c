/// \file
/// The flat faces of shapes, as places that span them.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/shape.h"

namespace portalens {

struct FlatFace {
  std::uint32_t face = 0;
  Vec3d normal;             ///< unit, as `surface_at` tells it
  std::vector<Vec3d> hull;  ///< a convex polygon that just holds it; in its plane
};

/// Of a shape that is no mesh, by face. A mesh is flat triangle by triangle: its own functions tell
/// them.
[[nodiscard]] std::vector<FlatFace> flat_faces(const Shape& shape);

}  // namespace portalens
