/// \file
/// A portal's polygon, ready for the questions that gravity asks: what of it is nearest to a point,
/// and whether a straight path runs through it. equations.md, sec. 5.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "math/frame.h"
#include "portal/portal.h"

namespace portalens {

/// An edge in the face's own plane coordinates and in space; `direction` is a unit vector.
struct FaceEdge {
  double start_x, start_y, direction_x, direction_y;
  double length;
  Vec3d start, direction;

  /// Distance to the right of the edge's line: outside the polygon where positive.
  [[nodiscard]] double outside(double x, double y) const {
    return (x - start_x) * direction_y - (y - start_y) * direction_x;
  }
  [[nodiscard]] double along(double x, double y) const {
    return (x - start_x) * direction_x + (y - start_y) * direction_y;
  }
};

/// What of a polygon is nearest: its inside, the inside of an edge, or a vertex.
struct Feature {
  enum class Kind : std::uint8_t { face, edge, vertex };
  Kind kind = Kind::face;
  std::uint32_t index = 0;

  [[nodiscard]] std::uint64_t code() const {
    return static_cast<std::uint64_t>(index) * 4 + static_cast<std::uint64_t>(kind);
  }
  friend bool operator==(const Feature&, const Feature&) = default;
};

/// A convex polygon with a front. Local coordinates are those of its frame: z is the height.
class PortalFace {
 public:
  explicit PortalFace(const Portal& portal);
  /// The polygon of `portal` carried elsewhere: `vertices` and `frame` are its own, moved alike.
  PortalFace(std::vector<Vec3d> vertices, const Frame& frame, double height_tolerance);

  [[nodiscard]] const Frame& frame() const { return frame_; }
  [[nodiscard]] const std::vector<FaceEdge>& edges() const { return edges_; }
  [[nodiscard]] double height_tolerance() const { return tolerance_; }
  [[nodiscard]] const std::vector<Vec3d>& vertices() const { return vertices_; }

  /// The feature nearest to `local`, by the one-sided rule: in front of the plane (or at height 0)
  /// of the polygon, behind it of the rim. Between edges equally near the lower index wins.
  [[nodiscard]] Feature nearest(Vec3d local) const;

  /// Whether `local` lies right behind the polygon, so that the rim is nearest: what goes on
  /// through the plane has the polygon before it at once.
  [[nodiscard]] bool is_behind(Vec3d local) const {
    return local.z < -tolerance_ && covers(local.x, local.y);
  }

  /// Within this distance of `local` the nearest point does not jump.
  [[nodiscard]] double distance_to_discontinuity(Vec3d local) const;

  /// The point of `feature` nearest to `local`, in local coordinates. An edge counts as its whole
  /// line and the face as its whole plane, so this is smooth in `local`.
  [[nodiscard]] Vec3d place(Feature feature, Vec3d local) const {
    switch (feature.kind) {
      case Feature::Kind::face:
        break;
      case Feature::Kind::edge: {
        const FaceEdge& edge = edges_[feature.index];
        const double s = edge.along(local.x, local.y);
        return {edge.start_x + edge.direction_x * s, edge.start_y + edge.direction_y * s, 0.0};
      }
      case Feature::Kind::vertex: {
        const FaceEdge& edge = edges_[feature.index];
        return {edge.start_x, edge.start_y, 0.0};
      }
    }
    return {local.x, local.y, 0.0};
  }

  /// True if the point's projection lies within the polygon, its rim included.
  [[nodiscard]] bool covers(double x, double y) const {
    for (const FaceEdge& edge : edges_)
      if (edge.outside(x, y) > 0.0) return false;
    return true;
  }

  /// Distance from a point of space to the polygon, from either side.
  [[nodiscard]] double distance(Vec3d x) const;

 private:
  [[nodiscard]] Feature nearest_from_outside(double x, double y) const;

  Frame frame_;
  std::vector<Vec3d> vertices_;
  std::vector<FaceEdge> edges_;
  double tolerance_;
};

}  // namespace portalens
