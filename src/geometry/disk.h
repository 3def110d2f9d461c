/// \file
/// A flat disk.
#pragma once

#include <optional>
#include <vector>

#include "geometry/flat_face.h"
#include "geometry/ray.h"

namespace portalens {

/// One face, 0. Texture coordinates are 0 to 1 over the square around it. It has no table of its
/// own in a scene: lamps are disks.
class Disk {
 public:
  /// @param normal  unit, of its front
  /// @pre radius > 0
  Disk(Vec3d center, Vec3d normal, double radius);

  [[nodiscard]] Vec3d normal() const { return normal_; }
  [[nodiscard]] Box bounds() const;
  [[nodiscard]] std::optional<Contact> intersect(const Ray& ray, double low, double high) const;
  [[nodiscard]] SurfacePoint surface_at(Vec3d x, std::uint32_t face) const;
  [[nodiscard]] double clearance(const Segment& segment) const;
  [[nodiscard]] Vec3d center_of_mass() const { return center_; }
  [[nodiscard]] double area() const;
  [[nodiscard]] SurfacePoint sample(double u1, double u2) const;
  [[nodiscard]] std::vector<FlatFace> flat_faces() const;

 private:
  [[nodiscard]] std::vector<Vec3d> hull() const;

  Vec3d center_, normal_, right_, up_;
  double radius_;
};

}  // namespace portalens
