/// \file
/// A flat convex quadrilateral, or a triangle.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/parameters.h"
#include "geometry/flat_face.h"
#include "geometry/ray.h"

namespace portalens {

using TextureCoordinates = std::array<double, 2>;

/// One face, 0; its front is where the vertices run counter-clockwise. Texture coordinates are (0,
/// 0), (1, 0), (1, 1), (0, 1) at the vertices, bilinear between them (a triangle: the first three,
/// linear), or go from each vertex's own to the next in the same way.
class Quad {
 public:
  static constexpr std::string_view name = "quad";
  /// 3 or 4 `vertices`; optional `texture_coordinates`, as many.
  static Quad from(Parameters& parameters);
  /// @param vertices  3 or 4, convex and planar
  /// @param texture_coordinates  as many, or none
  explicit Quad(std::span<const Vec3d> vertices,
                std::span<const TextureCoordinates> texture_coordinates = {});

  [[nodiscard]] std::span<const Vec3d> vertices() const { return {vertices_.data(), count_}; }
  [[nodiscard]] Vec3d normal() const { return normal_; }
  /// How far along the ray its plane is; infinite or no number where they are parallel.
  [[nodiscard]] double distance_of_plane(const Ray& ray) const {
    return dot(vertices_[0] - ray.origin, normal_) / dot(ray.direction, normal_);
  }

  [[nodiscard]] Box bounds() const;
  template <class Layout>
  [[nodiscard]] bool lay_out(Layout& layout) const {
    return layout.polygon(vertices(), normal_);
  }
  [[nodiscard]] std::optional<Contact> intersect(const Ray& ray, double low, double high) const;
  [[nodiscard]] SurfacePoint surface_at(Vec3d x, std::uint32_t face) const;
  /// The same without its texture coordinates, which take long.
  [[nodiscard]] SurfacePoint place_at(Vec3d x) const {
    SurfacePoint point;
    point.position = x - normal_ * dot(x - vertices_[0], normal_);
    point.normal = point.geometric_normal = normal_;
    const TextureCoordinates local = flat(x - vertices_[0]);
    point.flat = true;
    point.along = local[0];
    point.across = local[1];
    return point;
  }
  [[nodiscard]] double clearance(const Segment& segment) const;
  /// The mean of the vertices.
  [[nodiscard]] Vec3d center_of_mass() const;
  [[nodiscard]] double area() const;
  [[nodiscard]] SurfacePoint sample(double u1, double u2) const;
  [[nodiscard]] SeenSurface sample_seen(Vec3d x, double u1, double u2) const;
  [[nodiscard]] std::vector<FlatFace> flat_faces() const;

 private:
  /// A vector of the plane in (right, up).
  [[nodiscard]] TextureCoordinates flat(Vec3d d) const { return {dot(d, right_), dot(d, up_)}; }
  /// From 0 to 1 each way, of a place in (right, up) from the first vertex.
  [[nodiscard]] TextureCoordinates own_coordinates(TextureCoordinates place) const;

  std::array<Vec3d, 4> vertices_;
  std::array<TextureCoordinates, 4> texture_coordinates_;
  std::size_t count_;
  Vec3d normal_, right_, up_;
  /// In (right, up): the edges from the first vertex, and what the one opposite adds to the second.
  TextureCoordinates first_edge_{}, last_edge_{}, skew_{};
};

}  // namespace portalens
