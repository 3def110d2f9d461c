/// \file
/// What a scene says of a portal's face, and what polygons have in common.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <vector>

#include "math/frame.h"
#include "portal/plane_edge.h"

namespace portalens {

/// Where a portal's face is, and either its vertices or its radii.
struct FaceInput {
  Frame frame;
  std::vector<Vec3d> vertices;        ///< in space; those of a polygon
  std::array<double, 2> radii{0, 0};  ///< along `right` and `up`; those of an ellipse

  [[nodiscard]] std::vector<Vec3d> local_vertices() const {
    std::vector<Vec3d> local;
    for (const Vec3d& vertex : vertices) local.push_back(frame.to_local(vertex));
    return local;
  }
};

/// A rectangle along `right` and `up`.
struct PlaneBox {
  double low_x = std::numeric_limits<double>::infinity(), low_y = low_x;
  double high_x = -std::numeric_limits<double>::infinity(), high_y = high_x;
};

[[nodiscard]] PlaneBox box_of(std::span<const Vec3d> corners);
[[nodiscard]] double area_of(std::span<const Vec3d> corners);
[[nodiscard]] double longest_of(std::span<const PlaneEdge> edges);

/// Largest distance between a polygon's corners, half a turn about `up` further, and those of its
/// pair's that correspond to them (its v0, v1 land on the pair's v1, v0), divided by the longest
/// edge; infinite if the counts differ.
[[nodiscard]] double mismatch_of(std::span<const Vec3d> corners, std::span<const Vec3d> pair);

/// The first corner found on the wrong side of an edge, by more than a billionth of the longest;
/// the number of corners if there is none.
[[nodiscard]] std::size_t reentrant_corner(std::span<const Vec3d> corners);

}  // namespace portalens
