/// \file
/// A box.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/parameters.h"
#include "geometry/flat_face.h"
#include "geometry/pose.h"

namespace portalens {

/// Faces 0 to 5: -x, +x, -y, +y, -z, +z in its own coordinates. Each bears texture coordinates from
/// 0 to 1, upright and not mirrored seen from outside; the top's and the bottom's upper edges are
/// at -z and +z. Lengths along a face start in its lower left corner.
class Cube {
 public:
  static constexpr std::string_view name = "cube";
  static Cube from(Parameters& parameters);
  /// @param size  lengths of its edges, > 0
  Cube(Vec3d center, Vec3d size, Vec3d rotation) : pose_(center, rotation), half_(size * 0.5) {}

  [[nodiscard]] const Pose& pose() const { return pose_; }
  [[nodiscard]] Vec3d half() const { return half_; }  ///< of the lengths of its edges

  [[nodiscard]] Box bounds() const;
  [[nodiscard]] std::optional<Contact> intersect(const Ray& world, double low, double high) const;
  [[nodiscard]] SurfacePoint surface_at(Vec3d x, std::uint32_t face) const;
  [[nodiscard]] double clearance(const Segment& segment) const;
  [[nodiscard]] Vec3d center_of_mass() const { return pose_.middle(); }
  [[nodiscard]] double area() const;
  [[nodiscard]] SurfacePoint sample(double u1, double u2) const;
  [[nodiscard]] SeenSurface sample_seen(Vec3d x, double u1, double u2) const;
  [[nodiscard]] std::vector<FlatFace> flat_faces() const;

 private:
  Pose pose_;
  Vec3d half_;
};

}  // namespace portalens
