/// \file
/// What is drawn of a surface: its edges.
#pragma once

#include <vector>

#include "app/view.h"
#include "geometry/shape.h"

namespace portalens {

struct Outline {
  std::vector<std::vector<Vec3d>> edges;
  std::vector<std::vector<Vec3d>> grid;   ///< lines within a flat face, that show how it lies
  std::vector<std::vector<Vec3d>> faces;  ///< convex and flat, to be filled faintly
};

/// A shape's edges, and the edge of what is seen of it. A mesh has the edges at which it bends or
/// ends, or if it has too many triangles the box around it.
[[nodiscard]] Outline outline_of(const Shape& shape, const View& view);

}  // namespace portalens
