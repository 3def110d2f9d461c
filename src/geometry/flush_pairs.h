/// \file
/// Which flat faces of a scene lie in one plane and touch.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "geometry/flush.h"
#include "geometry/flush_face.h"

namespace portalens {

struct FlushPairs {
  using Pair = std::pair<std::uint32_t, std::uint32_t>;

  /// Those of shapes, then of openings, then triangles of meshes that lie in a plane with others.
  std::vector<FlushFace> faces;
  std::vector<Pair> pairs;  ///< of their indices
};

/// @param meshes  ascending by shape
[[nodiscard]] FlushPairs find_flush_pairs(const std::vector<Shape>& shapes,
                                          std::span<const MeshTriangles> meshes,
                                          std::span<const Opening> openings);

}  // namespace portalens
