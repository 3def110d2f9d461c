#include "geometry/flush.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "geometry/flat_regions.h"
#include "geometry/polygon.h"

namespace portalens {
namespace {

/// Faces no further from each other's plane than this share of their size and place lie in it.
constexpr double same_plane = 1e-9;
/// Tiles overlap by no more than that share.
constexpr double edge_rounding = 1e-12;
/// Sizes that differ by no more than this share are the same.
constexpr double same_size = 1e-9;
/// Up to so many faces are held against each other one by one.
constexpr std::size_t few = 40;

struct Face {
  FaceId id;
  bool opening = false;
  Vec3d normal;
  std::vector<Vec3d> hull;
  std::vector<std::vector<Vec3d>> pieces;  ///< none where the hull is all
  Box box;
  double extent = 0.0;      ///< of the object it is a face of; of a mesh, of its flat region
  double coordinate = 0.0;  ///< the largest

  void set_hull(std::vector<Vec3d> vertices) {
    hull = std::move(vertices);
    for (const Vec3d& vertex : hull) {
      box.add(vertex);
      coordinate = std::max(coordinate, largest_component(vertex));
    }
  }
};

double tolerance_of(const Face& a, const Face& b) {
  return same_plane * (std::max(a.coordinate, b.coordinate) + std::min(a.extent, b.extent));
}

bool lies_in_plane(const Face& face, const Face& other, double tolerance) {
  return std::all_of(face.hull.begin(), face.hull.end(), [&](const Vec3d& vertex) {
    return std::fabs(dot(vertex - other.hull[0], other.normal)) <= tolerance;
  });
}

bool in_one_plane(const Face& a, const Face& b) {
  const double tolerance = tolerance_of(a, b);
  return a.box.diagonal() <= b.box.diagonal() ? lies_in_plane(a, b, tolerance)
                                              : lies_in_plane(b, a, tolerance);
}

bool touch(const Box& a, const Box& b, double tolerance) {
  return a.low.x <= b.high.x + tolerance && b.low.x <= a.high.x + tolerance &&
         a.low.y <= b.high.y + tolerance && b.low.y <= a.high.y + tolerance &&
         a.low.z <= b.high.z + tolerance && b.low.z <= a.high.z + tolerance;
}

/// Whether both polygons lie on one side each of a line along an edge of `a`, but for the
/// tolerance.
bool an_edge_separates(const std::vector<Vec3d>& a, Vec3d normal, const std::vector<Vec3d>& b,
                       double tolerance) {
  const auto extent_along = [](const std::vector<Vec3d>& polygon, Vec3d axis) {
    std::pair<double, double> range{dot(polygon[0], axis), dot(polygon[0], axis)};
    for (const Vec3d& vertex : polygon) {
      const double at = dot(vertex, axis);
      range = {std::min(range.first, at), std::max(range.second, at)};
    }
    return range;
  };
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec3d edge = a[(i + 1) % a.size()] - a[i];
    if (!(length(edge) > 0.0)) continue;
    const Vec3d axis = cross(normal, normalize(edge));
    const auto [a_low, a_high] = extent_along(a, axis);
    const auto [b_low, b_high] = extent_along(b, axis);
    if (std::min(a_high, b_high) - std::max(a_low, b_low) <= tolerance) return true;
  }
  return false;
}

/// Whether two faces of one plane share more than an edge; by its rounding they may.
bool share_area(const Face& a, const Face& b) {
  const double tolerance = 4.0 * (edge_rounding / same_plane) * tolerance_of(a, b);
  const std::span<const std::vector<Vec3d>> as =
      a.pieces.empty() ? std::span(&a.hull, 1) : std::span(a.pieces);
  const std::span<const std::vector<Vec3d>> bs =
      b.pieces.empty() ? std::span(&b.hull, 1) : std::span(b.pieces);
  return std::any_of(as.begin(), as.end(), [&](const std::vector<Vec3d>& one) {
    return std::any_of(bs.begin(), bs.end(), [&](const std::vector<Vec3d>& other) {
      return !an_edge_separates(one, a.normal, other, tolerance) &&
             !an_edge_separates(other, b.normal, one, tolerance);
    });
  });
}

/// Whether `a` is met where both are.
bool comes_before(const Face& a, const Face& b) {
  if (a.opening != b.opening) return a.opening;
  if (a.opening) return a.id < b.id;
  const bool one_mesh = a.id.object == b.id.object;
  if (!one_mesh && std::fabs(a.extent - b.extent) > same_size * std::max(a.extent, b.extent))
    return a.extent < b.extent;
  return a.id > b.id;
}

}  // namespace

/// Finds the faces of one plane, and which of them cover each other.
class FlushBuilder {
 public:
  FlushBuilder(const std::vector<Shape>& shapes, std::span<const MeshTriangles> meshes,
               std::span<const Opening> openings)
      : meshes_(meshes), object_count_(shapes.size() + openings.size()) {
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

  void find_pairs() {
    if (plain_count_ > 1) plain_count_ <= few ? try_all() : try_by_tree();
    for (const MeshTriangles& mesh : meshes_)
      for (std::uint32_t i = 0; i < plain_count_; ++i) try_mesh(i, mesh);
    for (std::size_t i = 0; i < meshes_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) try_meshes(meshes_[j], meshes_[i]);
    for (const MeshTriangles& mesh : meshes_) try_itself(mesh);
  }

  void write(FlushFaces& out);

 private:
  using Pair = std::pair<std::uint32_t, std::uint32_t>;

  void add(FaceId id, bool opening, Vec3d normal, std::vector<Vec3d> hull, double extent) {
    Face& face = faces_.emplace_back();
    face.id = id;
    face.opening = opening;
    face.normal = normal;
    face.set_hull(std::move(hull));
    face.extent = opening ? face.box.diagonal() : extent;
  }

  void try_pair(std::uint32_t i, std::uint32_t j) {
    const Face &a = faces_[i], &b = faces_[j];
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
      const Face& face = faces_[i];
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

  [[nodiscard]] static Face face_of(const MeshTriangles& mesh, std::uint32_t triangle) {
    Face face;
    face.id = {mesh.shape, triangle};
    face.normal = mesh.mesh->normal(triangle);
    const auto corners = mesh.mesh->triangle(triangle);
    face.set_hull({corners.begin(), corners.end()});
    face.extent = face.box.diagonal();
    return face;
  }

  /// The index of that face, which is added unless it has been.
  std::uint32_t index_of(const Face& triangle) {
    const auto [at, fresh] =
        triangles_.emplace(triangle.id, static_cast<std::uint32_t>(faces_.size()));
    if (fresh) faces_.push_back(triangle);
    return at->second;
  }

  void try_mesh(std::uint32_t index, const MeshTriangles& mesh) {
    const double margin =
        2.0 * same_plane * (faces_[index].coordinate + faces_[index].box.diagonal());
    near(mesh, faces_[index].box, margin, [&](std::uint32_t triangle) {
      const Face other = face_of(mesh, triangle);
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
      const Face face = face_of(a, i);
      near(b, face.box, margin, [&](std::uint32_t triangle) {
        const Face other = face_of(b, triangle);
        if (touch(face.box, other.box, tolerance_of(face, other)) && in_one_plane(face, other))
          pairs_.emplace_back(index_of(face), index_of(other));
      });
    }
  }

  /// Triangles of one mesh that share an area. Those of one plane are few in most meshes, and the
  /// neighbours among them share edges alone.
  void try_itself(const MeshTriangles& mesh) {
    for (const auto& [i, j] : coplanar_overlaps(*mesh.mesh, *mesh.tree, same_plane)) {
      const Face a = face_of(mesh, i), b = face_of(mesh, j);
      if (in_one_plane(a, b) && share_area(a, b)) pairs_.emplace_back(index_of(a), index_of(b));
    }
  }

  void measure_regions();
  void group();
  [[nodiscard]] std::uint32_t root(std::uint32_t i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }

  std::span<const MeshTriangles> meshes_;
  std::size_t object_count_;
  std::size_t plain_count_ = 0;
  std::vector<Face> faces_;  ///< the plain ones, then triangles that lie in a plane with others
  std::map<FaceId, std::uint32_t> triangles_;
  std::vector<Pair> pairs_;
  std::vector<std::uint32_t> parent_;  ///< of faces of one plane; the root is the largest
};

/// Triangles count by the extent of the connected flat region that they lie in.
void FlushBuilder::measure_regions() {
  for (const MeshTriangles& mesh : meshes_) {
    const auto begin = triangles_.lower_bound({mesh.shape, 0});
    if (begin == triangles_.end() || begin->first.object != mesh.shape) continue;
    const std::vector<double> extents = flat_region_extents(*mesh.mesh, same_plane);
    for (auto at = begin; at != triangles_.end() && at->first.object == mesh.shape; ++at)
      faces_[at->second].extent = extents[at->first.face];
  }
}

/// Joins the planes of faces that touch, as long as the largest of all of them still agree.
void FlushBuilder::group() {
  parent_.resize(faces_.size());
  std::iota(parent_.begin(), parent_.end(), 0u);
  for (const auto& [i, j] : pairs_) {
    std::uint32_t large = root(i), small = root(j);
    if (large == small) continue;
    const auto size = [&](std::uint32_t k) { return faces_[k].box.diagonal(); };
    if (size(large) < size(small) || (size(large) == size(small) && small < large))
      std::swap(large, small);
    if (in_one_plane(faces_[small], faces_[large])) parent_[small] = large;
  }
}

void FlushBuilder::write(FlushFaces& out) {
  measure_regions();
  group();
  std::vector<std::vector<std::uint32_t>> over(faces_.size());
  std::vector<bool> told(faces_.size());
  for (std::uint32_t i = 0; i < faces_.size(); ++i) told[i] = faces_[i].opening;
  for (const auto& [i, j] : pairs_) {
    told[i] = told[j] = true;
    if (root(i) != root(j) || !share_area(faces_[i], faces_[j])) continue;
    const bool both = faces_[i].opening && faces_[j].opening;
    if (both || comes_before(faces_[i], faces_[j])) over[j].push_back(i);
    if (both || !comes_before(faces_[i], faces_[j])) over[i].push_back(j);
  }

  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < faces_.size(); ++i)
    if (told[i]) order.push_back(i);
  std::sort(order.begin(), order.end(),
            [this](std::uint32_t i, std::uint32_t j) { return faces_[i].id < faces_[j].id; });
  std::vector<std::uint32_t> plane_of(faces_.size(), LeftPlane::none);
  out.object_count_ = static_cast<std::uint32_t>(object_count_);
  out.first_.assign(object_count_ + 1, 0);
  for (const std::uint32_t i : order) {
    const std::uint32_t base = root(i);
    if (plane_of[base] == LeftPlane::none) {
      plane_of[base] = out.plane_count();
      out.planes_.push_back({faces_[base].normal, 0.0});
    }
    FlushFaces::Plane& plane = out.planes_[plane_of[base]];
    plane.thickness = std::max(plane.thickness, tolerance_of(faces_[i], faces_[base]));
    FlushFaces::Place place{faces_[i].id, plane_of[base], 1.0, 0, 0};
    place.side = dot(faces_[i].normal, plane.normal) < 0.0 ? -1.0 : 1.0;
    place.first_over = static_cast<std::uint32_t>(out.over_.size());
    std::sort(over[i].begin(), over[i].end(), [this](std::uint32_t a, std::uint32_t b) {
      return comes_before(faces_[a], faces_[b]);
    });
    for (const std::uint32_t k : over[i]) out.over_.push_back(faces_[k].id);
    place.end_over = static_cast<std::uint32_t>(out.over_.size());
    out.places_.push_back(place);
    ++out.first_[faces_[i].id.object + 1];
    out.any_shapes_ = out.any_shapes_ || !faces_[i].opening;
  }
  std::partial_sum(out.first_.begin(), out.first_.end(), out.first_.begin());
}

FlushFaces::FlushFaces(const std::vector<Shape>& shapes, std::span<const MeshTriangles> meshes,
                       std::span<const Opening> openings) {
  FlushBuilder builder(shapes, meshes, openings);
  builder.find_pairs();
  builder.write(*this);
}

const FlushFaces::Place* FlushFaces::find_among(std::uint32_t begin, std::uint32_t end,
                                                std::uint32_t face) const {
  const auto last = places_.begin() + end;
  const auto at =
      std::lower_bound(places_.begin() + begin, last, face,
                       [](const Place& place, std::uint32_t f) { return place.face.face < f; });
  return at != last && at->face.face == face ? &*at : nullptr;
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> FlushFaces::overlaps(std::size_t most) const {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const Place& place : places_)
    for (const FaceId& seen : over(place)) {
      if (pairs.size() == most) break;
      const auto* other = find(seen.object, seen.face);
      const auto back = over(*other);
      const bool both = std::find(back.begin(), back.end(), place.face) != back.end();
      if (!both || seen < place.face) pairs.emplace_back(seen.object, place.face.object);
    }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

LeftPlane FlushFaces::left_by(const SelfIntersectionGuard& guard) const {
  const Place* place = find(guard.shape, guard.face);
  if (!place) return {};
  return {place->plane, guard.side * place->side, guard.reach};
}

}  // namespace portalens
