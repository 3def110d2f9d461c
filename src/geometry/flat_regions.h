/// \file
/// Which triangles of a mesh lie in one plane.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/box_tree.h"
#include "geometry/mesh.h"

namespace portalens {

/// Of each triangle, the diagonal of the box of the flat region it belongs to: of all triangles
/// that hang together by whole edges and lie in one plane.
/// @param same_plane  share of place and size by which a vertex may lie off a plane
[[nodiscard]] std::vector<double> flat_region_extents(const Mesh& mesh, double same_plane);

/// Pairs of triangles i < j that lie in one plane and may overlap; not those that share an edge and
/// lie on both sides of it.
/// @param tree  over its triangles
[[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> coplanar_overlaps(
    const Mesh& mesh, const BoxTree& tree, double same_plane);

}  // namespace portalens
