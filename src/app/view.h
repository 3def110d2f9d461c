/// \file
/// From places of a scene to points of a drawing.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "app/drawing.h"
#include "geometry/ray.h"
#include "world/camera.h"

namespace portalens {

/// What a camera sees, on a rectangle of pixels whose top left corner is the drawing's. All points
/// it gives are finite and not far outside that rectangle.
class View {
 public:
  /// @param nearest  of a perspective camera: what lies less deep than this length is not seen; > 0
  View(const Camera& camera, int width, int height, double nearest);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

  /// Nothing if it lies too near, or outside the rectangle.
  [[nodiscard]] std::optional<Point> project(Vec3d place) const;
  /// The pieces of a line that are seen.
  [[nodiscard]] std::vector<PointChain> project_line(std::span<const Vec3d> places) const;
  /// The part of a flat area that is seen, or nothing.
  [[nodiscard]] PointChain project_area(std::span<const Vec3d> corners) const;

  /// Unit, from a place to the eye.
  [[nodiscard]] Vec3d towards_eye(Vec3d place) const;
  /// Unit, the way the camera looks.
  [[nodiscard]] Vec3d forward() const { return camera_.forward; }
  /// Whether a length has the same number of pixels wherever it lies.
  [[nodiscard]] bool uniform() const { return !perspective_; }
  /// How many pixels a short length across the view has there; 0 if it lies too near.
  [[nodiscard]] double pixels_per_length(Vec3d place) const;
  /// The closed circle on a sphere that is its edge as seen from the eye; empty if the eye is
  /// inside.
  [[nodiscard]] std::vector<Vec3d> silhouette(Vec3d center, double radius) const;

 private:
  /// To the right, upwards, into the depth.
  [[nodiscard]] Vec3d local(Vec3d place) const;
  [[nodiscard]] Point on_film(Vec3d local) const;
  /// Cuts off the part that lies too near; whether anything is left.
  [[nodiscard]] bool clip_depth(Vec3d& a, Vec3d& b) const;
  [[nodiscard]] bool clip_film(Point& a, Point& b) const;

  Camera camera_;
  int width_, height_;
  double nearest_;
  bool perspective_;
  double scale_;  ///< pixels a length, at depth 1 or at any depth
};

/// A circle about an axis, as a closed line.
[[nodiscard]] std::vector<Vec3d> circle_of(Vec3d center, Vec3d axis, double radius);

}  // namespace portalens
