#include "geometry/accelerator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "geometry/box_tree.h"
#include "geometry/contacts.h"
#include "geometry/distance_grid.h"
#include "geometry/polygon.h"
#include "geometry/slab.h"

namespace portalens {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Up to so many shapes other than meshes are tried one by one, each behind its box.
constexpr std::size_t few = 16;

/// Round surfaces that coincide are equally far away to the bit: then the later is met.
bool comes_before(const SurfaceHit& a, const SurfaceHit& b) {
  return std::tie(a.distance, b.shape, a.face) < std::tie(b.distance, a.shape, b.face);
}

struct MeshTree {
  std::uint32_t shape;
  const Mesh* mesh;
  BoxTree tree;
  DistanceGrid grid;
};

/// A query under way: what is asked for, and the best found so far.
struct Search {
  const Ray& ray;
  double low, high;
  const SelfIntersectionGuard& guard;
  std::optional<SurfaceHit> best;
  LeftPlane left;  ///< the plane of the self-intersection guard

  /// Takes the hit if it is the nearest so far; then only nearer ones matter.
  void offer(const SurfaceHit& hit) {
    if (!best || comes_before(hit, *best)) best = hit, high = hit.distance;
  }
};

}  // namespace

struct Accelerator::Implementation {
  std::vector<Shape> shapes;
  std::vector<Box> boxes;  ///< of each shape, a little grown
  Box bounds;
  std::vector<std::uint32_t> plain;  ///< the shapes that are no meshes
  std::vector<MeshTree> meshes;
  std::optional<BoxTree> plain_tree;  ///< over `plain`, if they are many
  FlushFaces flush;

  Implementation(std::vector<Shape> all, std::span<const Opening> openings);

  [[nodiscard]] SurfacePoint surface_at(std::uint32_t shape, std::uint32_t face, Vec3d x) const {
    return std::visit([&](const auto& s) { return s.surface_at(x, face); }, shapes[shape]);
  }
  [[nodiscard]] std::optional<Contact> intersect(std::uint32_t shape, const Ray& ray, double low,
                                                 double high) const {
    return std::visit([&](const auto& s) { return s.intersect(ray, low, high); }, shapes[shape]);
  }
  [[nodiscard]] double clearance(std::uint32_t shape, const Segment& segment) const {
    return std::visit([&](const auto& s) { return s.clearance(segment); }, shapes[shape]);
  }
  /// Whether this is the surface that the path has just left.
  [[nodiscard]] bool left_behind(const Search& search, const SurfaceHit& hit) const;
  /// The hit, or one of what lies in its plane and is met in its place there.
  [[nodiscard]] SurfaceHit uppermost(const SurfaceHit& hit, const Ray& ray) const;
  void try_plain(Search& search, std::uint32_t shape) const;
  /// @param free_until  no triangle of it is met before
  void try_mesh(Search& search, const MeshTree& mesh, double free_until) const;
  /// Null if it is no mesh, or has no triangles.
  [[nodiscard]] const MeshTree* mesh_of(std::uint32_t shape) const;
  [[nodiscard]] std::optional<SurfaceHit> run(Search search) const;
};

Accelerator::Implementation::Implementation(std::vector<Shape> all,
                                            std::span<const Opening> openings)
    : shapes(std::move(all)) {
  std::optional<TreeBuilder> builder;
  const auto tree = [&](std::size_t count, const auto& box_of) {
    if (!builder) builder.emplace();
    return BoxTree(*builder, static_cast<std::uint32_t>(count), box_of);
  };
  for (std::uint32_t i = 0; i < shapes.size(); ++i) {
    const Box box = std::visit([](const auto& s) { return s.bounds(); }, shapes[i]);
    bounds.add(box);
    boxes.push_back(box.grown(1e-9 * (box.diagonal() + length(box.middle()))));
    const auto* mesh = std::get_if<Mesh>(&shapes[i]);
    if (!mesh) {
      plain.push_back(i);
    } else if (mesh->triangle_count() > 0) {
      const auto box_of = [mesh](std::uint32_t face) {
        Box triangle;
        for (const Vec3d& corner : mesh->triangle(face)) triangle.add(corner);
        return triangle;
      };
      meshes.push_back({i, mesh, tree(mesh->triangle_count(), box_of), DistanceGrid(*mesh)});
    }
  }
  if (plain.size() > few)
    plain_tree.emplace(
        tree(plain.size(), [this](std::uint32_t item) { return boxes[plain[item]]; }));
  std::vector<MeshTriangles> triangles;
  for (const MeshTree& mesh : meshes) triangles.push_back({mesh.shape, mesh.mesh, &mesh.tree});
  flush = FlushFaces(shapes, triangles, openings);
}

const MeshTree* Accelerator::Implementation::mesh_of(std::uint32_t shape) const {
  const auto at = std::lower_bound(
      meshes.begin(), meshes.end(), shape,
      [](const MeshTree& mesh, std::uint32_t which) { return mesh.shape < which; });
  return at != meshes.end() && at->shape == shape ? &*at : nullptr;
}

bool Accelerator::Implementation::left_behind(const Search& search, const SurfaceHit& hit) const {
  const SelfIntersectionGuard& guard = search.guard;
  const Ray& ray = search.ray;
  if (search.left.plane != LeftPlane::none) {
    const auto* place = flush.find(hit.shape, hit.face);
    if (place && flush.is_behind(search.left, *place, ray, hit.distance)) return true;
  }
  if (hit.shape != guard.shape) return false;
  const auto* quad = std::get_if<Quad>(&shapes[hit.shape]);
  const Vec3d normal = quad
                           ? quad->normal()
                           : surface_at(hit.shape, hit.face, ray.at(hit.distance)).geometric_normal;
  const double slope = dot(ray.direction, normal);
  if (!(slope * guard.side > 0.0)) return false;
  if (hit.face == guard.face && hit.distance <= guard.reach) return true;
  const Box& box = boxes[hit.shape];
  const double rounding = rounding_at(ray.origin, box.middle()) + 1e-14 * box.diagonal();
  return hit.distance * std::fabs(slope) <= rounding;
}

void Accelerator::Implementation::try_plain(Search& search, std::uint32_t shape) const {
  double low = search.low;
  while (const auto contact = intersect(shape, search.ray, low, search.high)) {
    const SurfaceHit hit{shape, contact->face, contact->distance};
    if (!left_behind(search, hit)) return search.offer(hit);
    low = std::nextafter(contact->distance, infinity);
  }
}

void Accelerator::Implementation::try_mesh(Search& search, const MeshTree& mesh,
                                           double free_until) const {
  mesh.tree.along(search.ray, free_until, search.high, [&](std::uint32_t face) {
    const auto distance = mesh.mesh->cross_triangle(face, search.ray);
    if (distance && *distance >= search.low && *distance <= search.high) {
      const SurfaceHit hit{mesh.shape, face, *distance};
      if (!left_behind(search, hit)) search.offer(hit);
    }
    return search.high;
  });
}

SurfaceHit Accelerator::Implementation::uppermost(const SurfaceHit& hit, const Ray& ray) const {
  const auto* place = flush.find(hit.shape, hit.face);
  if (!place) return hit;
  const FlushFaces::Plane& plane = flush.plane(place->plane);
  const Ray across{ray.at(hit.distance), plane.normal};
  const double reach =
      4.0 * plane.thickness + 4e-15 * (length(ray.origin) + std::fabs(hit.distance));
  for (const FaceId& over : flush.over(*place)) {
    if (over.object >= shapes.size()) continue;
    const auto* mesh = std::get_if<Mesh>(&shapes[over.object]);
    const auto at = mesh ? mesh->cross_triangle(over.face, across) : std::nullopt;
    const bool there = mesh ? at && std::fabs(*at) <= reach
                            : intersect(over.object, across, -reach, reach).has_value();
    if (there) return {over.object, over.face, hit.distance};
  }
  return hit;
}

std::optional<SurfaceHit> Accelerator::Implementation::run(Search search) const {
  if (!is_finite(search.ray.origin) || !is_finite(search.ray.direction)) return std::nullopt;
  if (search.guard.shape != no_object) search.left = flush.left_by(search.guard);
  const Slab slab(search.ray);
  const auto may_meet = [&](std::uint32_t shape) {
    const auto [first, last] = slab.clip(boxes[shape], search.low, search.high);
    return first <= last;
  };
  if (plain_tree) {
    plain_tree->along(search.ray, search.low, search.high, [&](std::uint32_t item) {
      if (may_meet(plain[item])) try_plain(search, plain[item]);
      return search.high;
    });
  } else {
    for (const std::uint32_t shape : plain)
      if (may_meet(shape)) try_plain(search, shape);
  }
  for (const MeshTree& mesh : meshes) {
    const auto [first, last] = slab.clip(boxes[mesh.shape], search.low, search.high);
    if (!(first <= last)) continue;
    const double low = mesh.grid.free_until(search.ray, first, last, 0.0);
    if (low <= last) try_mesh(search, mesh, low);
  }
  if (search.best && flush.any_shapes()) return uppermost(*search.best, search.ray);
  return search.best;
}

Accelerator::Accelerator(std::vector<Shape> shapes, std::span<const Opening> openings)
    : implementation_(std::make_unique<Implementation>(std::move(shapes), openings)) {}
Accelerator::~Accelerator() = default;
Accelerator::Accelerator(Accelerator&&) noexcept = default;
Accelerator& Accelerator::operator=(Accelerator&&) noexcept = default;

const std::vector<Shape>& Accelerator::shapes() const { return implementation_->shapes; }
const Box& Accelerator::bounds() const { return implementation_->bounds; }
const FlushFaces& Accelerator::flush() const { return implementation_->flush; }

std::optional<SurfaceHit> Accelerator::nearest(const Ray& ray, double low, double high,
                                               const SelfIntersectionGuard& guard) const {
  return implementation_->run({ray, low, high, guard, std::nullopt, {}});
}

bool Accelerator::blocked(const Ray& ray, double low, double high,
                          const SelfIntersectionGuard& guard) const {
  return nearest(ray, low, high, guard).has_value();
}

double Accelerator::clearance(Vec3d x, double limit) const {
  const Implementation& all = *implementation_;
  if (!is_finite(x)) return 0.0;
  double least = limit;
  for (const MeshTree& mesh : all.meshes) least = std::min(least, mesh.grid.clearance(x));
  for (const std::uint32_t shape : all.plain)
    if (all.boxes[shape].distance(x) < least) least = std::min(least, all.clearance(shape, {x, x}));
  return least;
}

bool Accelerator::near(const Segment& segment, double radius) const {
  const Implementation& all = *implementation_;
  const Vec3d way = segment.b - segment.a;
  const double size = length(way);
  if (!std::isfinite(size) || !is_finite(segment.a) || !(radius < infinity)) return true;
  const Ray ray{segment.a, size > 0.0 ? way / size : Vec3d{1, 0, 0}};
  const Slab slab(ray);
  const auto part_near = [&](std::uint32_t shape) {
    return slab.clip(all.boxes[shape].grown(radius), 0.0, size);
  };
  for (const std::uint32_t shape : all.plain) {
    const auto [first, last] = part_near(shape);
    if (first <= last && all.clearance(shape, segment) <= radius) return true;
  }
  for (const MeshTree& mesh : all.meshes) {
    const auto [first, last] = part_near(mesh.shape);
    if (!(first <= last)) continue;
    if (mesh.grid.free_until(ray, first, last, radius) <= last) return true;
  }
  return false;
}

std::optional<Contact> Accelerator::contact_near(std::uint32_t shape, std::uint32_t face,
                                                 const Ray& ray, double reach) const {
  const Implementation& all = *implementation_;
  if (!is_finite(ray.origin) || !is_finite(ray.direction)) return std::nullopt;
  if (const auto* quad = std::get_if<Quad>(&all.shapes[shape])) {
    const auto at = line_through_polygon(quad->vertices(), quad->normal(), ray);
    return at && std::fabs(*at) <= reach ? std::optional(Contact{*at, 0}) : std::nullopt;
  }
  const Ray back{ray.origin, -ray.direction};
  std::optional<Contact> ahead, behind;
  if (const auto* mesh = std::get_if<Mesh>(&all.shapes[shape])) {
    const auto own = mesh->cross_triangle(face, ray);
    if (own && std::fabs(*own) <= reach) return Contact{*own, face};
    const MeshTree* tree = all.mesh_of(shape);
    const SelfIntersectionGuard none;
    const auto search = [&](const Ray& way, double limit) -> std::optional<Contact> {
      Search query{way, 0.0, limit, none, std::nullopt, {}};
      all.try_mesh(query, *tree, 0.0);
      if (!query.best) return std::nullopt;
      return Contact{query.best->distance, query.best->face};
    };
    ahead = search(ray, reach);
    behind = search(back, ahead ? ahead->distance : reach);
  } else {
    ahead = all.intersect(shape, ray, 0.0, reach);
    behind = all.intersect(shape, back, 0.0, ahead ? ahead->distance : reach);
  }
  if (behind && (!ahead || behind->distance < ahead->distance))
    return Contact{-behind->distance, behind->face};
  return ahead;
}

SurfaceHit Accelerator::uppermost(const SurfaceHit& hit, const Ray& ray) const {
  return implementation_->uppermost(hit, ray);
}

SurfacePoint Accelerator::surface_at(std::uint32_t shape, std::uint32_t face, Vec3d x) const {
  return implementation_->surface_at(shape, face, x);
}

}  // namespace portalens
