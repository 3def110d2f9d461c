/// \file
/// Triangulating polygons: of a mesh file, of a portal.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "math/vec3.h"

namespace portalens {

/// Indices into `points`, three a triangle, n - 2 triangles, turning the way the polygon does. A
/// quad is cut along its shorter inner diagonal, a convex polygon into a fan, any other by ears
/// (Meisters 1975), seen along its mean normal (Newell). An outline may go round holes, to each by
/// a bridge that it comes back on: they stay open. One that crosses itself gives triangles all the
/// same.
[[nodiscard]] std::vector<std::array<std::size_t, 3>> triangulate(const std::vector<Vec3d>& points);

}  // namespace portalens
