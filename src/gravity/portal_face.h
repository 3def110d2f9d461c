/// \file
/// A portal's face, ready for the questions that gravity asks: what of it is nearest to a point,
/// and whether a straight path runs through it. equations.md, sec. 5.
#pragma once

#include <cstdint>
#include <vector>

#include "math/frame.h"
#include "portal/portal.h"

namespace portalens {

/// An edge in the face's own plane coordinates and in space; both directions are unit vectors.
struct FaceEdge : PlaneEdge {
  Vec3d start, direction;
};

/// A face with a front. Local coordinates are those of its frame: z is the height.
class PortalFace {
 public:
  explicit PortalFace(const Portal& portal);
  /// The face of a portal carried elsewhere: `aperture` and `frame` are moved alike.
  PortalFace(Aperture aperture, const Frame& frame, double height_tolerance);

  [[nodiscard]] const Frame& frame() const { return frame_; }
  [[nodiscard]] const Aperture& aperture() const { return aperture_; }
  /// Of a polygon.
  [[nodiscard]] const std::vector<FaceEdge>& edges() const { return edges_; }
  /// Null of a polygon.
  [[nodiscard]] const Ellipse* ellipse() const { return std::get_if<Ellipse>(&aperture_); }
  [[nodiscard]] bool is_convex_polygon() const {
    return std::holds_alternative<ConvexPolygon>(aperture_);
  }
  [[nodiscard]] double height_tolerance() const { return tolerance_; }

  /// The feature nearest to `local`, by the one-sided rule: in front of the plane (or at height 0)
  /// of the face, behind it of the rim. Between edges equally near the lower index wins.
  [[nodiscard]] Feature nearest(Vec3d local) const {
    return ask(aperture_, [&](const auto& a) { return a.nearest(local, tolerance_); });
  }

  /// Whether `local` lies right behind the face, so that the rim is nearest: what goes on
  /// through the plane has the face before it at once.
  [[nodiscard]] bool is_behind(Vec3d local) const {
    return local.z < -tolerance_ && covers(local.x, local.y);
  }

  /// Within this distance of `local` the nearest point does not jump.
  [[nodiscard]] double distance_to_discontinuity(Vec3d local) const {
    return ask(aperture_,
               [&](const auto& a) { return a.distance_to_discontinuity(local, tolerance_); });
  }
  /// Within this distance of `local` its nearest point, of that feature, does not move at all.
  [[nodiscard]] double still(Feature feature, Vec3d local) const {
    return ask(aperture_, [&](const auto& a) { return a.still(feature, local); });
  }

  /// The same feature, as it is for another place.
  [[nodiscard]] Feature follow(Feature feature, Vec3d local) const {
    return ask(aperture_, [&](const auto& a) { return a.follow(feature, local); });
  }
  /// The point of `feature` nearest to `local`, for which it was found, or followed; in local
  /// coordinates. An edge counts as its whole line and the face as its whole plane, so this is
  /// smooth in `local`.
  [[nodiscard]] Vec3d place(Feature feature, Vec3d local) const {
    if (feature.kind == Feature::Kind::face) return {local.x, local.y, 0.0};
    return ask(aperture_, [&](const auto& a) { return a.place(feature, local); });
  }
  /// How that point runs as `local` does.
  [[nodiscard]] Pace pace(Feature feature, Vec3d local) const {
    return ask(aperture_, [&](const auto& a) { return a.pace(feature, local); });
  }

  /// True if the point's projection lies within the face, its rim included.
  [[nodiscard]] bool covers(double x, double y) const {
    return ask(aperture_, [&](const auto& a) { return a.covers(x, y); });
  }

  /// Distance from a point of space to the face, from either side.
  [[nodiscard]] double distance(Vec3d x) const;

 private:
  Frame frame_;
  Aperture aperture_;
  std::vector<FaceEdge> edges_;
  double tolerance_;
};

}  // namespace portalens
