/// \file
/// A convex polygon as the face of a portal: Dunigan & Pianta, sec. 4.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "portal/face_input.h"
#include "portal/plane_edge.h"

namespace portalens {

/// Corners run counter-clockwise, in coordinates of the plane.
class ConvexPolygon {
 public:
  static constexpr std::string_view name = "convex polygon";
  static constexpr bool curved = false;

  ConvexPolygon() = default;  ///< holds nothing yet
  /// @pre at least 3 corners, convex to 1e-9 of the longest edge
  explicit ConvexPolygon(std::vector<Vec3d> corners);
  /// Nothing of vertices that are not convex.
  [[nodiscard]] static std::optional<ConvexPolygon> from(const FaceInput& input);
  /// The same elsewhere, with these corners.
  [[nodiscard]] ConvexPolygon carried(std::vector<Vec3d> corners) const {
    return ConvexPolygon(std::move(corners));
  }

  [[nodiscard]] bool within(double x, double y, double slack) const {
    for (const Side& side : sides_)
      if ((side.dx * (y - side.y) - side.dy * (x - side.x)) / side.length < -slack) return false;
    return true;
  }
  [[nodiscard]] bool covers(double x, double y) const {
    for (const PlaneEdge& edge : edges_)
      if (edge.outside(x, y) > 0.0) return false;
    return true;
  }
  [[nodiscard]] Feature nearest(Vec3d local, double tolerance) const {
    // Inside the outline the nearest rim point is the foot on the nearest edge line; several may be
    // equally near there. Outside of it the nearest point is unique, and the same from both sides.
    std::uint32_t best = 0;
    double least_inside = -std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < edges_.size(); ++i) {
      const double outside = edges_[i].outside(local.x, local.y);
      if (outside > 0.0) return nearest_from_outside(local.x, local.y);
      if (outside > least_inside + tolerance) {
        least_inside = outside;
        best = i;
      }
    }
    if (local.z >= -tolerance) return {Feature::Kind::face, 0};
    return {Feature::Kind::edge, best};
  }
  [[nodiscard]] Feature follow(Feature feature, Vec3d) const { return feature; }
  [[nodiscard]] Vec3d place(Feature feature, Vec3d local) const {
    return place_on(edges_, feature, local);
  }
  [[nodiscard]] Pace pace(Feature feature, Vec3d) const {
    return {feature.kind == Feature::Kind::vertex ? 0.0 : 1.0};
  }
  [[nodiscard]] double distance_to_discontinuity(Vec3d local, double tolerance) const;
  [[nodiscard]] double still(Feature feature, Vec3d local) const {
    return stillness_on(edges_, feature, local);
  }

  [[nodiscard]] const std::vector<PlaneEdge>& edges() const { return edges_; }
  template <class Layout>
  void lay_out(Layout& layout) const {
    layout.polygon(edges_, true);
  }
  [[nodiscard]] const std::vector<Vec3d>& outline() const { return corners_; }
  [[nodiscard]] std::vector<std::vector<Vec3d>> pieces() const { return {corners_}; }
  [[nodiscard]] std::vector<std::vector<Vec3d>> gaps() const { return {}; }
  [[nodiscard]] PlaneBox box() const { return box_of(corners_); }
  [[nodiscard]] double size() const { return longest_of(edges_); }
  [[nodiscard]] double area() const { return area_of(corners_); }
  [[nodiscard]] double mismatch(const ConvexPolygon& pair) const {
    return mismatch_of(corners_, pair.corners_);
  }

 private:
  [[nodiscard]] Feature nearest_from_outside(double x, double y) const;

  /// An edge again, as `within` asks it.
  struct Side {
    double x, y, dx, dy, length;
  };

  std::vector<Vec3d> corners_;
  std::vector<PlaneEdge> edges_;
  std::vector<Side> sides_;  ///< the last edge first
};

}  // namespace portalens
