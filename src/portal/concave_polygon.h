/// \file
/// A simple polygon that is not convex, as the face of a portal. Ours; equations.md, sec. 4.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "portal/face_input.h"
#include "portal/plane_edge.h"

namespace portalens {

/// Corners run counter-clockwise, in coordinates of the plane; no edge touches another but where
/// they follow each other.
class ConcavePolygon {
 public:
  static constexpr std::string_view name = "concave polygon";
  static constexpr bool curved = false;

  explicit ConcavePolygon(std::vector<Vec3d> corners);
  /// Nothing of a convex one.
  [[nodiscard]] static std::optional<ConcavePolygon> from(const FaceInput& input);
  [[nodiscard]] ConcavePolygon carried(std::vector<Vec3d> corners) const {
    return ConcavePolygon(std::move(corners));
  }

  [[nodiscard]] bool within(double x, double y, double slack) const;
  [[nodiscard]] bool covers(double x, double y) const;
  /// The nearest point jumps also where a notch has two sides as near.
  [[nodiscard]] Feature nearest(Vec3d local, double tolerance) const;
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
    layout.polygon(edges_, false);
  }
  [[nodiscard]] const std::vector<Vec3d>& outline() const { return corners_; }
  [[nodiscard]] std::vector<std::vector<Vec3d>> pieces() const;
  [[nodiscard]] std::vector<std::vector<Vec3d>> gaps() const;
  [[nodiscard]] PlaneBox box() const { return box_; }
  [[nodiscard]] double size() const { return longest_of(edges_); }
  [[nodiscard]] double area() const { return area_of(corners_); }
  [[nodiscard]] double mismatch(const ConcavePolygon& pair) const {
    return mismatch_of(corners_, pair.corners_);
  }

 private:
  /// The square of the distance from an edge.
  [[nodiscard]] double square_from(const PlaneEdge& edge, double x, double y) const;

  std::vector<Vec3d> corners_;
  std::vector<PlaneEdge> edges_;
  std::vector<bool> reentrant_;  ///< of the corner that an edge begins with
  PlaneBox box_;
};

/// Two edges that meet where they do not follow each other, by their first corners; nothing of a
/// simple polygon. What comes nearer than a billionth of the longest edge counts as met.
struct MetEdges {
  std::size_t first, second;
};
[[nodiscard]] std::optional<MetEdges> edges_that_meet(std::span<const Vec3d> corners);

}  // namespace portalens
