#include "geometry/flush_pairs.h"

#include <cstddef>
#include <map>

#include "geometry/flat_regions.h"

namespace portalens {
namespace {

/// Up to so many faces are held against each other one by one.
constexpr std::size_t few = 40;

/// Of plain faces, those of shapes and openings, and of the triangles of meshes.
class PairFinder {
 public:
  PairFinder(const std::vector<Shape>& shapes, std::span<const MeshTriangles> meshes,
             std::span<const Opening> openings)
      : meshes_(meshes) {
    for (std::uint32_t i = 0; i < shapes.size(); ++i) {
      const double extent =
          std::visit([](const auto& s) { return s.bounds(); }, shapes[i]).diagonal();
      for (FlatFace& flat : std::visit([](const auto& s) { return s.flat_faces(); }, shapes[i]))
        add({i, flat.face}, false, flat.normal, std::move(flat.hull), extent);
    }
    for (std::uint32_t i = 0; i < openings.size(); ++i)
      add({static_cast<std::uint32_t>(shapes.size()) + i, 0}, true, openings[i].normal,
          {openings[i].vertices.begin(), openings[i].vertices.end()}, 0.0);
    for (std::uint32_t i = 0; i < openings.size(); ++i)
      if (openings[i].pieces.size() > 1)
        faces_[faces_.size() - openings.size() + i].pieces = openings[i].pieces;
    plain_count_ = faces_.size();
  }

  [[nodiscard]] FlushPairs find() && {
    if (plain_count_ > 1) plain_count_ <= few ? try_all() : try_by_tree();
    for (const MeshTriangles& mesh : meshes_)
      for (std::uint32_t i = 0; i < plain_count_; ++i) try_mesh(i, mesh);
    for (std::size_t i = 0; i < meshes_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) try_meshes(meshes_[j], meshes_[i]);
    for (const MeshTriangles& mesh : meshes_) try_itself(mesh);
    measure_regions();
    return {std::move(faces_), std::move(pairs_)};
  }

 private:
  void add(FaceId id, bool opening, Vec3d normal, std::vector<Vec3d> hull, double extent) {
    FlushFace& face = faces_.emplace_back();
    face.id = id;
    face.opening = opening;
    face.normal = normal;
    face.set_hull(std::move(hull));
    face.extent = opening ? face.box.diagonal() : extent;
  }

  void try_pair(std::uint32_t i, std::uint32_t j) {
    const FlushFace &a = faces_[i], &b = faces_[j];
    if (a.id.object == b.id.object && !touch(a.box, b.box, 0.0)) return;
    if (touch(a.box, b.box, tolerance_of(a, b)) && in_one_plane(a, b)) pairs_.emplace_back(i, j);
  }

  void try_all() {
    for (std::uint32_t i = 0; i < plain_count_; ++i)
      for (std::uint32_t j = i + 1; j < plain_count_; ++j)
        if (faces_[i].id.object != faces_[j].id.object) try_pair(i, j);
  }

  /// Each pair is found from its smaller face.
  void try_by_tree() {
    const TreeBuilder builder;
    const BoxTree tree(builder, static_cast<std::uint32_t>(plain_count_),
                       [this](std::uint32_t i) { return faces_[i].box; });
    for (std::uint32_t i = 0; i < plain_count_; ++i) {
      const FlushFace& face = faces_[i];
      const double size = face.box.diagonal();
      const double radius = 0.5 * size + 2.0 * same_plane * (face.coordinate + size);
      tree.around(face.box.middle(), radius, [&](std::uint32_t j) {
        const double other = faces_[j].box.diagonal();
        if (faces_[j].id.object != face.id.object && (other > size || (other == size && j > i)))
          try_pair(i, j);
        return radius;
      });
    }
  }

  /// Visits the triangles of a mesh that may touch the box.
  template <class Visit>
  static void near(const MeshTriangles& mesh, const Box& box, double margin, const Visit& visit) {
    const Box whole = mesh.mesh->bounds();
    if (!touch(box, whole, margin)) return;
    const Box& small = box.diagonal() < whole.diagonal() ? box : whole;
    const double radius = 0.5 * small.diagonal() + margin;
    mesh.tree->around(small.middle(), radius, [&](std::uint32_t triangle) {
      visit(triangle);
      return radius;
    });
  }

  [[nodiscard]] static FlushFace face_of(const MeshTriangles& mesh, std::uint32_t triangle) {
    FlushFace face;
    face.id = {mesh.shape, triangle};
    face.normal = mesh.mesh->normal(triangle);
    const auto corners = mesh.mesh->triangle(triangle);
    face.set_hull({corners.begin(), corners.end()});
    face.extent = face.box.diagonal();
    return face;
  }

  /// The index of that face, which is added unless it has been.
  std::uint32_t index_of(const FlushFace& triangle) {
    const auto [at, fresh] =
        triangles_.emplace(triangle.id, static_cast<std::uint32_t>(faces_.size()));
    if (fresh) faces_.push_back(triangle);
    return at->second;
  }

  void try_mesh(std::uint32_t index, const MeshTriangles& mesh) {
    const double margin =
        2.0 * same_plane * (faces_[index].coordinate + faces_[index].box.diagonal());
    near(mesh, faces_[index].box, margin, [&](std::uint32_t triangle) {
      const FlushFace other = face_of(mesh, triangle);
      if (touch(faces_[index].box, other.box, tolerance_of(faces_[index], other)) &&
          in_one_plane(faces_[index], other))
        pairs_.emplace_back(index, index_of(other));
    });
  }

  void try_meshes(const MeshTriangles& a, const MeshTriangles& b) {
    const Box whole = b.mesh->bounds();
    const double margin = 2.0 * same_plane * (length(whole.middle()) + whole.diagonal());
    if (!touch(a.mesh->bounds(), whole, margin)) return;
    for (std::uint32_t i = 0; i < a.mesh->triangle_count(); ++i) {
      const FlushFace face = face_of(a, i);
      near(b, face.box, margin, [&](std::uint32_t triangle) {
        const FlushFace other = face_of(b, triangle);
        if (touch(face.box, other.box, tolerance_of(face, other)) && in_one_plane(face, other))
          pairs_.emplace_back(index_of(face), index_of(other));
      });
    }
  }

  /// Triangles of one mesh that share an area. Those of one plane are few in most meshes, and the
  /// neighbours among them share edges alone.
  void try_itself(const MeshTriangles& mesh) {
    for (const auto& [i, j] : coplanar_overlaps(*mesh.mesh, *mesh.tree, same_plane)) {
      const FlushFace a = face_of(mesh, i), b = face_of(mesh, j);
      if (in_one_plane(a, b) && share_area(a, b)) pairs_.emplace_back(index_of(a), index_of(b));
    }
  }

  /// Triangles count by the extent of the connected flat region that they lie in.
  void measure_regions() {
    for (const MeshTriangles& mesh : meshes_) {
      const auto begin = triangles_.lower_bound({mesh.shape, 0});
      if (begin == triangles_.end() || begin->first.object != mesh.shape) continue;
      const std::vector<double> extents = flat_region_extents(*mesh.mesh, same_plane);
      for (auto at = begin; at != triangles_.end() && at->first.object == mesh.shape; ++at)
        faces_[at->second].extent = extents[at->first.face];
    }
  }

  std::span<const MeshTriangles> meshes_;
  std::size_t plain_count_ = 0;
  /// The plain ones, then triangles that lie in a plane with others.
  std::vector<FlushFace> faces_;
  std::map<FaceId, std::uint32_t> triangles_;
  std::vector<FlushPairs::Pair> pairs_;
};

}  // namespace

FlushPairs find_flush_pairs(const std::vector<Shape>& shapes, std::span<const MeshTriangles> meshes,
                            std::span<const Opening> openings) {
  return PairFinder(shapes, meshes, openings).find();
}

}  // namespace portalens
