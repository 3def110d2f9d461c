/// \file
/// What the rim of a portal's face is made of, in the coordinates of its plane.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "math/vec3.h"

namespace portalens {

/// An edge of a polygon whose corners run counter-clockwise; `direction` is a unit vector.
struct PlaneEdge {
  double start_x, start_y, direction_x, direction_y;
  double length;

  /// Distance to the right of the edge's line: outside a convex polygon where positive.
  [[nodiscard]] double outside(double x, double y) const {
    return (x - start_x) * direction_y - (y - start_y) * direction_x;
  }
  [[nodiscard]] double along(double x, double y) const {
    return (x - start_x) * direction_x + (y - start_y) * direction_y;
  }
};

/// What of a face is nearest: its inside, the inside of an edge (or of a piece of a curved rim), or
/// a vertex.
struct Feature {
  enum class Kind : std::uint8_t { face, edge, vertex };
  Kind kind = Kind::face;
  std::uint32_t index = 0;
  /// Of a curved rim, the angle at which the nearest point was found: from there it is followed. No
  /// decision, so it does not tell features apart.
  double cosine = 1.0, sine = 0.0;

  [[nodiscard]] std::uint64_t code() const {
    return static_cast<std::uint64_t>(index) * 4 + static_cast<std::uint64_t>(kind);
  }
  friend bool operator==(const Feature& a, const Feature& b) { return a.code() == b.code(); }
};

/// How the nearest point of a feature runs as the place does that it is nearest to.
struct Pace {
  double speed = 1.0;  ///< at the most, per length of that place's path
  /// How far that place is from where the point would be led round at once: of a curved rim, its
  /// centre of curvature.
  double pivot = std::numeric_limits<double>::infinity();
};

/// The edges between corners that are given in coordinates of the plane.
[[nodiscard]] inline std::vector<PlaneEdge> edges_between(std::span<const Vec3d> corners) {
  std::vector<PlaneEdge> edges;
  edges.reserve(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3d &a = corners[i], &b = corners[(i + 1) % corners.size()];
    const double dx = b.x - a.x, dy = b.y - a.y;
    const double size = std::sqrt(dx * dx + dy * dy);
    edges.push_back({a.x, a.y, dx / size, dy / size, size});
  }
  return edges;
}

/// The point of an edge's line or of a vertex that is nearest to `local`, or of the whole plane: of
/// a polygon's feature.
[[nodiscard]] inline Vec3d place_on(std::span<const PlaneEdge> edges, Feature feature,
                                    Vec3d local) {
  switch (feature.kind) {
    case Feature::Kind::face:
      break;
    case Feature::Kind::edge: {
      const PlaneEdge& edge = edges[feature.index];
      const double s = edge.along(local.x, local.y);
      return {edge.start_x + edge.direction_x * s, edge.start_y + edge.direction_y * s, 0.0};
    }
    case Feature::Kind::vertex: {
      const PlaneEdge& edge = edges[feature.index];
      return {edge.start_x, edge.start_y, 0.0};
    }
  }
  return {local.x, local.y, 0.0};
}

/// Within this distance of `local` its nearest point, of that feature, does not move at all: only a
/// vertex may stay so.
[[nodiscard]] inline double stillness_on(std::span<const PlaneEdge> edges, Feature feature,
                                         Vec3d local) {
  if (feature.kind != Feature::Kind::vertex) return 0.0;
  const PlaneEdge& next = edges[feature.index];
  const PlaneEdge& last = edges[(feature.index + edges.size() - 1) % edges.size()];
  return std::fmax(
      0.0, std::fmin(-next.along(local.x, local.y), last.along(local.x, local.y) - last.length));
}

}  // namespace portalens
