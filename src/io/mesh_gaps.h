/// \file
/// What the faces of a mesh leave out in its file: normals, texture coordinates, materials.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "core/parameters.h"
#include "math/triangles.h"
#include "math/vec3.h"

namespace portalens {

/// The index of what a face leaves out.
inline constexpr std::uint32_t left_out = std::numeric_limits<std::uint32_t>::max();

/// A normal of no length stays so, and counts as left out.
[[nodiscard]] Vec3d unit_normal(Vec3d n);

/// Gives faces what they leave out and others have. What all leave out, the mesh is without:
/// corners then name the first that there would be.
/// @param where  messages say that a material stands which is made up here
void fill_gaps(Triangles& mesh, std::vector<Table>& materials, const Location& where);

}  // namespace portalens
