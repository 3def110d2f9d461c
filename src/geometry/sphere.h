/// \file
/// A sphere.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/parameters.h"
#include "geometry/flat_face.h"
#include "geometry/ray.h"

namespace portalens {

/// One face, 0. Texture coordinates: u = 1/2 + atan2(x, z) / 2π, v = 1/2 + asin(y / r) / π.
class Sphere {
 public:
  static constexpr std::string_view name = "sphere";
  static Sphere from(Parameters& parameters);
  Sphere(Vec3d center, double radius) : center_(center), radius_(radius) {}

  [[nodiscard]] Vec3d center() const { return center_; }
  [[nodiscard]] double radius() const { return radius_; }

  [[nodiscard]] Box bounds() const;
  template <class Layout>
  [[nodiscard]] bool lay_out(Layout& layout) const {
    return layout.ball(center_, radius_);
  }
  [[nodiscard]] std::optional<Contact> intersect(const Ray& ray, double low, double high) const;
  [[nodiscard]] SurfacePoint surface_at(Vec3d x, std::uint32_t face) const;
  [[nodiscard]] double clearance(const Segment& segment) const;
  [[nodiscard]] Vec3d center_of_mass() const { return center_; }
  [[nodiscard]] double area() const;
  [[nodiscard]] SurfacePoint sample(double u1, double u2) const;
  [[nodiscard]] SeenSurface sample_seen(Vec3d x, double u1, double u2) const;
  [[nodiscard]] std::vector<FlatFace> flat_faces() const { return {}; }

 private:
  Vec3d center_;
  double radius_;
};

}  // namespace portalens
