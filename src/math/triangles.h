/// \file
/// The triangles of a mesh, as a file gives them and a shape is made from them.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "math/vec3.h"

namespace portalens {

/// Corners index `positions`, and `normals` and `uvs` where those are not empty.
struct Triangles {
  struct Corner {
    std::uint32_t position = 0, normal = 0, uv = 0;
  };
  std::vector<Vec3d> positions;
  std::vector<Vec3d> normals;  ///< unit; empty: flat shading
  std::vector<std::array<double, 2>> uvs;
  std::vector<std::array<Corner, 3>> corners;  ///< one entry a triangle
  std::vector<std::uint32_t> material_of;      ///< one a triangle, or empty
};

}  // namespace portalens
