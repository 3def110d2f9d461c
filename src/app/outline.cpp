#include "app/outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

namespace portalens {
namespace {

using Line = std::vector<Vec3d>;

constexpr int max_cells = 10;                  ///< of the grid along a quad's longest edge
constexpr std::size_t max_triangles = 200000;  ///< of a mesh whose edges are looked for
constexpr double smooth = 0.9;                 ///< cosine between faces of one smooth surface

void add_box(const std::array<Vec3d, 8>& corners, Outline& outline) {
  for (unsigned corner = 0; corner < 8; ++corner)
    for (const unsigned axis : {1u, 2u, 4u})
      if ((corner & axis) == 0) outline.edges.push_back({corners[corner], corners[corner | axis]});
}

void add_box(const Box& box, Outline& outline) {
  if (box.empty()) return;
  std::array<Vec3d, 8> corners;
  for (unsigned i = 0; i < 8; ++i)
    corners[i] = {i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y,
                  i & 4 ? box.high.z : box.low.z};
  add_box(corners, outline);
}

/// The lines between two opposite edges, a-b and d-c, that share them out evenly.
void add_grid(Vec3d a, Vec3d b, Vec3d c, Vec3d d, int cells, Outline& outline) {
  for (int i = 1; i < cells; ++i) {
    const double share = static_cast<double>(i) / cells;
    outline.grid.push_back({a + (b - a) * share, d + (c - d) * share});
  }
}

/// Where the wall of a round body turns away from the eye: lines from its lower to its upper rim.
void add_wall_edges(const Pose& pose, double height, double lower, double upper, const View& view,
                    Outline& outline) {
  constexpr int parts = 180;
  const auto rim = [&](double angle, double radius, double y) {
    return pose.to_world({radius * std::cos(angle), y, radius * std::sin(angle)});
  };
  const auto faces_eye = [&](double angle) {
    const Vec3d normal =
        pose.turned({height * std::cos(angle), lower - upper, height * std::sin(angle)});
    return dot(normal, view.towards_eye(rim(angle, 0.5 * (lower + upper), 0.0))) > 0.0;
  };
  constexpr double part = 2.0 * std::numbers::pi / parts;
  for (int i = 0; i < parts; ++i) {
    if (faces_eye(i * part) == faces_eye((i + 1) * part)) continue;
    const double angle = (i + 0.5) * part;
    outline.edges.push_back({rim(angle, lower, -0.5 * height), rim(angle, upper, 0.5 * height)});
  }
}

void add_rim(const Pose& pose, double y, double radius, Outline& outline) {
  if (radius > 0.0)
    outline.edges.push_back(circle_of(pose.to_world({0, y, 0}), pose.turned({0, 1, 0}), radius));
}

/// An edge of a triangle, the same whichever of its triangles it is taken from.
struct MeshEdge {
  Vec3d a, b, normal;
  bool facing = false;

  [[nodiscard]] auto key() const { return std::tuple(a.x, a.y, a.z, b.x, b.y, b.z); }
};

bool drawn(const MeshEdge& one, const MeshEdge& other) {
  return dot(one.normal, other.normal) < smooth || one.facing != other.facing;
}

struct Outliner {
  const View& view;
  Outline& outline;

  void operator()(const Sphere& sphere) const {
    outline.edges.push_back(view.silhouette(sphere.center(), sphere.radius()));
    outline.faces.push_back(outline.edges.back());
  }

  void operator()(const Quad& quad) const {
    const auto corners = quad.vertices();
    Line loop(corners.begin(), corners.end());
    outline.faces.push_back(loop);
    loop.push_back(loop.front());
    outline.edges.push_back(loop);
    if (corners.size() < 4) return;
    const double along = std::max(length(loop[1] - loop[0]), length(loop[2] - loop[3]));
    const double across = std::max(length(loop[2] - loop[1]), length(loop[3] - loop[0]));
    const double cell = std::max(along, across) / max_cells;
    const auto cells = [&](double edge) { return static_cast<int>(std::lround(edge / cell)); };
    add_grid(loop[0], loop[1], loop[2], loop[3], cells(along), outline);
    add_grid(loop[1], loop[2], loop[3], loop[0], cells(across), outline);
  }

  void operator()(const Cube& cube) const {
    std::array<Vec3d, 8> corners;
    for (unsigned i = 0; i < 8; ++i) {
      const Vec3d half = cube.half();
      corners[i] = cube.pose().to_world(
          {i & 1 ? half.x : -half.x, i & 2 ? half.y : -half.y, i & 4 ? half.z : -half.z});
    }
    add_box(corners, outline);
  }

  void operator()(const Cone& cone) const {
    add_rim(cone.pose(), -0.5 * cone.height(), cone.radius(), outline);
    add_wall_edges(cone.pose(), cone.height(), cone.radius(), 0.0, view, outline);
  }

  void operator()(const Cylinder& cylinder) const {
    add_tube(cylinder.pose(), cylinder.height(), cylinder.radius());
  }

  void operator()(const Ring& ring) const {
    add_tube(ring.pose(), ring.height(), ring.outer_radius());
    add_rim(ring.pose(), -0.5 * ring.height(), ring.inner_radius(), outline);
    add_rim(ring.pose(), 0.5 * ring.height(), ring.inner_radius(), outline);
  }

  void operator()(const Mesh& mesh) const {
    if (mesh.triangle_count() > max_triangles)
      add_box(mesh.bounds(), outline);
    else
      add_mesh_edges(mesh);
  }

  /// What this drawing has no lines for.
  template <class Other>
  void operator()(const Other& shape) const {
    add_box(shape.bounds(), outline);
  }

 private:
  void add_tube(const Pose& pose, double height, double radius) const {
    add_rim(pose, -0.5 * height, radius, outline);
    add_rim(pose, 0.5 * height, radius, outline);
    add_wall_edges(pose, height, radius, radius, view, outline);
  }

  void add_mesh_edges(const Mesh& mesh) const {
    std::vector<MeshEdge> edges;
    for (std::uint32_t face = 0; face < mesh.triangle_count(); ++face) {
      const std::array<Vec3d, 3> corners = mesh.triangle(face);
      const Vec3d normal = mesh.normal(face);
      const bool facing = dot(normal, view.towards_eye(corners[0])) > 0.0;
      for (std::size_t i = 0; i < 3; ++i) {
        const MeshEdge edge{corners[i], corners[(i + 1) % 3], normal, facing};
        const MeshEdge turned{edge.b, edge.a, normal, facing};
        edges.push_back(turned.key() < edge.key() ? turned : edge);
      }
    }
    std::stable_sort(edges.begin(), edges.end(),
                     [](const MeshEdge& a, const MeshEdge& b) { return a.key() < b.key(); });
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
      while (end < edges.size() && edges[end].key() == edges[begin].key()) ++end;
      if (end - begin != 2 || drawn(edges[begin], edges[begin + 1]))
        outline.edges.push_back({edges[begin].a, edges[begin].b});
    }
  }
};

}  // namespace

Outline outline_of(const Shape& shape, const View& view) {
  Outline outline;
  std::visit(Outliner{view, outline}, shape);
  return outline;
}

}  // namespace portalens
