/// \file
/// A mesh of triangles.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/parameters.h"
#include "geometry/flat_face.h"
#include "geometry/ray.h"
#include "math/triangles.h"

namespace portalens {

/// How a mesh is laid into the scene: scaled about the origin of its file, turned about the middle
/// of its own box by degrees (x first, then y, then z), then moved.
struct MeshPlacement {
  Vec3d translate;
  Vec3d rotation;
  Vec3d scale{1, 1, 1};
};

/// Faces are its triangles, without the degenerate ones. Copies share the triangles.
///
/// `from` gives a mesh without triangles: the geometry room opens no files. Whoever does hands the
/// triangles of `file()` to `loaded`.
class Mesh {
 public:
  static constexpr std::string_view name = "mesh";
  /// Keys file, translate, rotation, scale (a number, or one for each axis; > 0).
  static Mesh from(Parameters& parameters);
  Mesh() = default;
  /// A mesh whose triangles stand where they are.
  explicit Mesh(Triangles triangles);

  [[nodiscard]] const std::string& file() const { return file_; }
  /// The same mesh with these triangles, scaled, turned and moved. Triangles without area, with an
  /// index out of range or a value that is not finite, or beyond ±1e12, are left out.
  [[nodiscard]] Mesh loaded(Triangles triangles) const;

  [[nodiscard]] std::size_t triangle_count() const;
  [[nodiscard]] std::array<Vec3d, 3> triangle(std::uint32_t face) const;
  /// Unit, to the side from which the corners run counter-clockwise.
  [[nodiscard]] Vec3d normal(std::uint32_t face) const;
  /// The file's own material of a triangle; none if it names none.
  [[nodiscard]] std::optional<std::uint32_t> material_of(std::uint32_t face) const;
  /// Whether each edge is shared by exactly two triangles that run along it in opposite directions.
  /// Positions that are equal count as one.
  [[nodiscard]] bool closed() const;

  [[nodiscard]] Box bounds() const;
  [[nodiscard]] std::optional<Contact> intersect(const Ray& ray, double low, double high) const;
  [[nodiscard]] SurfacePoint surface_at(Vec3d x, std::uint32_t face) const;
  /// From a point of a face to the smooth surface that its normals tell of, where that bulges to
  /// the given side (1: where `normal` points, -1); 0 where it is flat, falls in, or the normals
  /// turn too much to tell of one. Hanika, "Hacking the Shadow Terminator", Ray Tracing Gems II,
  /// 2021.
  [[nodiscard]] Vec3d bulge_at(Vec3d x, std::uint32_t face, double side) const;
  [[nodiscard]] double clearance(const Segment& segment) const;
  /// Of the volume if it is closed, else of the area; the origin if there are no triangles.
  [[nodiscard]] Vec3d center_of_mass() const;
  [[nodiscard]] double area() const;
  /// @pre there are triangles
  [[nodiscard]] SurfacePoint sample(double u1, double u2) const;
  /// None: it is flat triangle by triangle, which its own functions tell.
  [[nodiscard]] static std::vector<FlatFace> flat_faces() { return {}; }

  /// Where the line of the ray crosses one triangle.
  [[nodiscard]] std::optional<double> cross_triangle(std::uint32_t face, const Ray& ray) const;

 private:
  struct Data;

  std::string file_;
  MeshPlacement placement_;
  std::shared_ptr<const Data> data_;
};

}  // namespace portalens
