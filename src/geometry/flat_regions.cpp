#include "geometry/flat_regions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <tuple>

#include "geometry/polygon.h"

namespace portalens {
namespace {

using Corners = std::array<Vec3d, 3>;

bool lies_in_plane(const Corners& triangle, const Corners& other, Vec3d normal, double tolerance) {
  return std::all_of(triangle.begin(), triangle.end(), [&](const Vec3d& corner) {
    return std::fabs(dot(corner - other[0], normal)) <= tolerance;
  });
}

double tolerance_of(const Corners& triangle, double same_plane) {
  Box box;
  double coordinate = 0.0;
  for (const Vec3d& corner : triangle) {
    box.add(corner);
    coordinate = std::max(coordinate, largest_component(corner));
  }
  return same_plane * (coordinate + box.diagonal());
}

/// An edge of a triangle, its ends in an order of their own.
struct Edge {
  std::array<double, 6> ends;
  std::uint32_t triangle;

  Edge(Vec3d a, Vec3d b, std::uint32_t of) : triangle(of) {
    if (std::tie(b.x, b.y, b.z) < std::tie(a.x, a.y, a.z)) std::swap(a, b);
    ends = {a.x, a.y, a.z, b.x, b.y, b.z};
  }
};

std::vector<Edge> sorted_edges(const Mesh& mesh) {
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangle_count());
  for (std::uint32_t i = 0; i < mesh.triangle_count(); ++i) {
    const Corners t = mesh.triangle(i);
    for (std::size_t k = 0; k < 3; ++k) edges.emplace_back(t[k], t[(k + 1) % 3], i);
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.ends, a.triangle) < std::tie(b.ends, b.triangle);
  });
  return edges;
}

/// Nearly equal of triangles in one plane.
struct PlaneKey {
  double turn;    ///< tells normals apart, of either sense
  double offset;  ///< of the plane, from the middle of the mesh
  std::uint32_t triangle;
};

PlaneKey key_of(const Mesh& mesh, std::uint32_t triangle) {
  Vec3d normal = mesh.normal(triangle);
  // Directions in which few meshes have faces: those at right angles to the first change sense.
  constexpr Vec3d upwards{0.8427, 0.4139, 0.3442}, aslant{0.3193, -0.7811, 0.5367};
  if (dot(normal, upwards) < 0.0) normal = -normal;
  return {dot(normal, aslant), dot(mesh.triangle(triangle)[0] - mesh.bounds().middle(), normal),
          triangle};
}

/// Calls `visit` for each stretch of sorted keys in which neighbours are no further apart.
template <class Keys, class Visit>
void for_each_cluster(Keys keys, double PlaneKey::*value, double apart, const Visit& visit) {
  for (std::size_t begin = 0; begin < keys.size();) {
    std::size_t end = begin + 1;
    while (end < keys.size() && keys[end].*value - keys[end - 1].*value <= apart) ++end;
    visit(keys.subspan(begin, end - begin));
    begin = end;
  }
}

}  // namespace

std::vector<double> flat_region_extents(const Mesh& mesh, double same_plane) {
  std::vector<std::uint32_t> parent(mesh.triangle_count());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  const std::vector<Edge> edges = sorted_edges(mesh);
  for (std::size_t i = 1; i < edges.size(); ++i) {
    if (edges[i].ends != edges[i - 1].ends) continue;
    const std::uint32_t a = edges[i - 1].triangle, b = edges[i].triangle;
    const Corners t = mesh.triangle(a);
    if (lies_in_plane(mesh.triangle(b), t, mesh.normal(a), tolerance_of(t, same_plane)))
      parent[std::max(root(a), root(b))] = std::min(root(a), root(b));
  }
  std::vector<Box> boxes(mesh.triangle_count());
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    for (const Vec3d& corner : mesh.triangle(i)) boxes[root(i)].add(corner);
  std::vector<double> extents(boxes.size());
  for (std::uint32_t i = 0; i < extents.size(); ++i) extents[i] = boxes[root(i)].diagonal();
  return extents;
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> coplanar_overlaps(const Mesh& mesh,
                                                                       const BoxTree& tree,
                                                                       double same_plane) {
  std::vector<PlaneKey> keys;
  keys.reserve(mesh.triangle_count());
  for (std::uint32_t i = 0; i < mesh.triangle_count(); ++i) keys.push_back(key_of(mesh, i));
  std::sort(keys.begin(), keys.end(),
            [](const PlaneKey& a, const PlaneKey& b) { return a.turn < b.turn; });
  const Box& whole = mesh.bounds();
  const double apart =
      8.0 * same_plane *
      (std::max(largest_component(whole.low), largest_component(whole.high)) + whole.diagonal());

  // Which plane each triangle lies in, where others do, too.
  constexpr std::uint32_t alone = 0xffffffffu;
  std::vector<std::uint32_t> plane(keys.size(), alone);
  std::uint32_t planes = 0;
  const auto mark = [&](std::span<const PlaneKey> group) {
    if (group.size() > 1) {
      for (const PlaneKey& key : group) plane[key.triangle] = planes;
      ++planes;
    }
  };
  for_each_cluster(std::span(keys), &PlaneKey::turn, 1e-7, [&](std::span<PlaneKey> parallel) {
    std::sort(parallel.begin(), parallel.end(),
              [](const PlaneKey& a, const PlaneKey& b) { return a.offset < b.offset; });
    for_each_cluster(parallel, &PlaneKey::offset, apart, mark);
  });

  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
  for (std::uint32_t i = 0; i < plane.size(); ++i) {
    if (plane[i] == alone) continue;
    Box box;
    for (const Vec3d& corner : mesh.triangle(i)) box.add(corner);
    const double radius = 0.5 * box.diagonal();
    tree.around(box.middle(), radius, [&](std::uint32_t j) {
      if (j > i && plane[j] == plane[i]) found.emplace_back(i, j);
      return radius;
    });
  }
  return found;
}

}  // namespace portalens
