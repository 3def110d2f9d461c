/// \file
/// A closed cylinder.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/parameters.h"
#include "geometry/flat_face.h"
#include "geometry/pose.h"

namespace portalens {

/// Stands on its base along y. Faces: 0 the side, 1 the bottom, 2 the top. Texture coordinates: u
/// around, v from 0 at the bottom to 1; a cap bears the square around its disc.
class Cylinder {
 public:
  static constexpr std::string_view name = "cylinder";
  static Cylinder from(Parameters& parameters);
  /// @param base  middle of the bottom before it is rotated
  Cylinder(Vec3d base, double height, double radius, Vec3d rotation)
      : pose_(base + Vec3d{0, 0.5 * height, 0}, rotation), half_(0.5 * height), radius_(radius) {}

  [[nodiscard]] const Pose& pose() const { return pose_; }
  [[nodiscard]] double height() const { return 2.0 * half_; }
  [[nodiscard]] double radius() const { return radius_; }

  [[nodiscard]] Box bounds() const;
  [[nodiscard]] std::optional<Contact> intersect(const Ray& world, double low, double high) const;
  [[nodiscard]] SurfacePoint surface_at(Vec3d x, std::uint32_t face) const;
  [[nodiscard]] double clearance(const Segment& segment) const;
  [[nodiscard]] Vec3d center_of_mass() const { return pose_.middle(); }
  [[nodiscard]] double area() const;
  [[nodiscard]] SurfacePoint sample(double u1, double u2) const;
  [[nodiscard]] std::vector<FlatFace> flat_faces() const;

 private:
  Pose pose_;
  double half_;  ///< of the height
  double radius_;
};

}  // namespace portalens
