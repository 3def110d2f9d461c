/// \file
/// Whether a list of vertices is a simple planar polygon, as a portal may be one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "math/vec3.h"

namespace portalens {

struct PolygonFault {
  std::string problem, remedy;
};

/// @pre at least 3 vertices
/// @return what is wrong with the polygon, if anything is; "vertices ..."
[[nodiscard]] std::optional<PolygonFault> polygon_fault(const std::vector<Vec3d>& vertices);

[[nodiscard]] double longest_edge(const std::vector<Vec3d>& vertices);

/// `[x, y, z] [x, y, z] ...`
[[nodiscard]] std::string written(const std::vector<Vec3d>& vertices);

}  // namespace portalens
