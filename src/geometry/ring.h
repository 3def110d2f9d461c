/// \file
/// A closed solid ring: what is left of a cylinder when a thinner one is taken out.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/parameters.h"
#include "geometry/flat_face.h"
#include "geometry/pose.h"

namespace portalens {

/// Stands on its base along y. Faces: 0 the outer wall, 1 the inner wall, 2 the bottom, 3 the top.
/// Texture coordinates: u around, v from 0 at the bottom to 1; a cap bears the square around its
/// outer rim. An inner radius of 0 leaves a cylinder.
class Ring {
 public:
  static constexpr std::string_view name = "ring";
  static Ring from(Parameters& parameters);
  /// @param base  middle of the bottom before it is rotated
  /// @pre 0 <= inner < outer
  Ring(Vec3d base, double height, double inner, double outer, Vec3d rotation)
      : pose_(base + Vec3d{0, 0.5 * height, 0}, rotation),
        half_(0.5 * height),
        inner_(inner),
        outer_(outer) {}

  [[nodiscard]] const Pose& pose() const { return pose_; }
  [[nodiscard]] double height() const { return 2.0 * half_; }
  [[nodiscard]] double inner_radius() const { return inner_; }
  [[nodiscard]] double outer_radius() const { return outer_; }

  [[nodiscard]] Box bounds() const;
  [[nodiscard]] std::optional<Contact> intersect(const Ray& world, double low, double high) const;
  [[nodiscard]] SurfacePoint surface_at(Vec3d x, std::uint32_t face) const;
  [[nodiscard]] double clearance(const Segment& segment) const;
  [[nodiscard]] Vec3d center_of_mass() const { return pose_.middle(); }
  [[nodiscard]] double area() const;
  [[nodiscard]] SurfacePoint sample(double u1, double u2) const;
  [[nodiscard]] std::vector<FlatFace> flat_faces() const;

 private:
  /// Distance from a point of the ring's own coordinates to its surface.
  [[nodiscard]] double distance(Vec3d local) const;

  Pose pose_;
  double half_;  ///< of the height
  double inner_, outer_;
};

}  // namespace portalens
