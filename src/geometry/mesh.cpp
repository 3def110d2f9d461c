#include "geometry/mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "geometry/extent.h"
#include "geometry/polygon.h"
#include "math/rigid.h"
#include "math/weld.h"

namespace portalens {

struct Mesh::Data {
  Triangles triangles;
  std::vector<std::array<Vec3d, 3>> places;  ///< of each triangle's corners, side by side
  Box bounds;
  std::vector<double> area_up_to;  ///< sum of the areas of the triangles up to each
};

namespace {

using Corners = std::array<Triangles::Corner, 3>;

Vec3d area_vector(const std::array<Vec3d, 3>& t) { return cross(t[1] - t[0], t[2] - t[0]) * 0.5; }

std::array<Vec3d, 3> positions_of(const Triangles& t, const Corners& corners) {
  return {t.positions[corners[0].position], t.positions[corners[1].position],
          t.positions[corners[2].position]};
}

bool indices_hold(const Triangles& t, const Corners& corners) {
  return std::all_of(corners.begin(), corners.end(), [&](const Triangles::Corner& c) {
    return c.position < t.positions.size() && (t.normals.empty() || c.normal < t.normals.size()) &&
           (t.uvs.empty() || c.uv < t.uvs.size());
  });
}

/// Whether a triangle has an area from which a normal can be told.
bool has_area(const std::array<Vec3d, 3>& t) {
  double longest = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(largest_component(t[i]) <= largest_coordinate)) return false;
    longest = std::fmax(longest, length(t[(i + 1) % 3] - t[i]));
  }
  return longest > 1e-100 && length(area_vector(t)) > 1e-13 * longest * longest;
}

void drop_unsound(Triangles& t) {
  std::size_t kept = 0;
  const bool has_materials = t.material_of.size() == t.corners.size();
  for (std::size_t i = 0; i < t.corners.size(); ++i) {
    if (!indices_hold(t, t.corners[i]) || !has_area(positions_of(t, t.corners[i]))) continue;
    t.corners[kept] = t.corners[i];
    if (has_materials) t.material_of[kept] = t.material_of[i];
    ++kept;
  }
  t.corners.resize(kept);
  t.material_of.resize(has_materials ? kept : 0);
}

void place(Triangles& t, const MeshPlacement& placement) {
  Box box;
  for (Vec3d& p : t.positions) {
    p = p * placement.scale;
    if (is_finite(p)) box.add(p);
  }
  if (box.empty()) return;
  Rigid motion = rotation_about(box.middle(), placement.rotation);
  motion.to += placement.translate;
  for (Vec3d& p : t.positions) p = motion.move(p);
  const Vec3d& s = placement.scale;
  for (Vec3d& n : t.normals) {
    const Vec3d turned = motion.rotate({n.x / s.x, n.y / s.y, n.z / s.z});
    const double size = length(turned);
    n = size > 0.0 && std::isfinite(size) ? turned / size : Vec3d{};
  }
}

/// Shares of the corners at the point of the triangle below `x`; not negative, their sum is 1.
std::array<double, 3> weights_at(const std::array<Vec3d, 3>& t, Vec3d x) {
  const Vec3d normal = area_vector(t) * 2.0;
  const double square = dot(normal, normal);
  std::array<double, 3> weights;
  double sum = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d from = t[(i + 1) % 3];
    const double share = dot(cross(t[(i + 2) % 3] - from, x - from), normal) / square;
    sum += weights[i] = std::clamp(share, 0.0, 1.0);
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

}  // namespace

Mesh Mesh::from(Parameters& parameters) {
  Mesh mesh;
  mesh.file_ = parameters.text("file");
  mesh.placement_.translate = to_vec3(parameters.triple("translate", any_number, Triple{}));
  mesh.placement_.rotation = to_vec3(parameters.triple("rotation", any_number, Triple{}));
  mesh.placement_.scale =
      to_vec3(parameters.number_or_triple("scale", positive, Triple{1.0, 1.0, 1.0}));
  return mesh;
}

Mesh::Mesh(Triangles triangles) : Mesh(Mesh().loaded(std::move(triangles))) {}

Mesh Mesh::loaded(Triangles triangles) const {
  place(triangles, placement_);
  drop_unsound(triangles);
  auto data = std::make_shared<Data>();
  double sum = 0.0;
  data->area_up_to.reserve(triangles.corners.size());
  data->places.reserve(triangles.corners.size());
  for (const Corners& corners : triangles.corners) {
    const auto t = positions_of(triangles, corners);
    for (const Vec3d& p : t) data->bounds.add(p);
    data->places.push_back(t);
    data->area_up_to.push_back(sum += length(area_vector(t)));
  }
  data->triangles = std::move(triangles);
  Mesh mesh = *this;
  mesh.data_ = std::move(data);
  return mesh;
}

std::size_t Mesh::triangle_count() const { return data_ ? data_->triangles.corners.size() : 0; }

std::array<Vec3d, 3> Mesh::triangle(std::uint32_t face) const { return data_->places[face]; }

Vec3d Mesh::normal(std::uint32_t face) const { return normalize(area_vector(triangle(face))); }

std::optional<std::uint32_t> Mesh::material_of(std::uint32_t face) const {
  if (data_->triangles.material_of.empty()) return std::nullopt;
  return data_->triangles.material_of[face];
}

bool Mesh::closed() const {
  if (triangle_count() == 0) return false;
  const auto first = welded(data_->triangles.positions);
  struct Edge {
    std::uint32_t low, high;
    int way;
  };
  std::vector<Edge> edges;
  edges.reserve(3 * triangle_count());
  for (const Corners& corners : data_->triangles.corners)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto a = first[corners[i].position], b = first[corners[(i + 1) % 3].position];
      edges.push_back({std::min(a, b), std::max(a, b), a < b ? 0 : 1});
    }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.low, a.high, a.way) < std::tie(b.low, b.high, b.way);
  });
  const auto same = [](const Edge& a, const Edge& b) { return a.low == b.low && a.high == b.high; };
  if (edges.size() % 2 != 0) return false;
  for (std::size_t i = 0; i < edges.size(); i += 2) {
    if (!same(edges[i], edges[i + 1]) || edges[i].way == edges[i + 1].way) return false;
    if (i > 0 && same(edges[i - 1], edges[i])) return false;
  }
  return true;
}

Box Mesh::bounds() const { return data_ ? data_->bounds : Box{}; }

std::optional<double> Mesh::cross_triangle(std::uint32_t face, const Ray& ray) const {
  const auto t = triangle(face);
  return line_through_polygon(t, area_vector(t), ray);
}

std::optional<Contact> Mesh::intersect(const Ray& ray, double low, double high) const {
  std::optional<Contact> best;
  for (std::uint32_t face = 0; face < triangle_count(); ++face) {
    const auto distance = cross_triangle(face, ray);
    if (!distance || !(*distance >= low && *distance <= high)) continue;
    if (!best || *distance < best->distance) best = Contact{*distance, face};
  }
  return best;
}

SurfacePoint Mesh::surface_at(Vec3d x, std::uint32_t face) const {
  const Triangles& all = data_->triangles;
  const Corners& corners = all.corners[face];
  const auto t = triangle(face);
  SurfacePoint point;
  point.geometric_normal = normal(face);
  point.position = x - point.geometric_normal * dot(x - t[0], point.geometric_normal);
  const auto weights = weights_at(t, point.position);
  Vec3d shading;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!all.normals.empty()) shading += all.normals[corners[i].normal] * weights[i];
    if (all.uvs.empty()) continue;
    point.u += weights[i] * all.uvs[corners[i].uv][0];
    point.v += weights[i] * all.uvs[corners[i].uv][1];
  }
  if (all.uvs.empty()) point.u = weights[1], point.v = weights[2];
  const double size = length(shading);
  point.normal = size > 1e-6 && dot(shading, point.geometric_normal) > 0.0 ? shading / size
                                                                           : point.geometric_normal;
  return point;
}

Vec3d Mesh::bulge_at(Vec3d x, std::uint32_t face, double side) const {
  constexpr double least_cosine = 0.7;  // a cube whose normals are smoothed is no ball
  const Triangles& all = data_->triangles;
  if (all.normals.empty()) return {};
  const auto t = triangle(face);
  const Vec3d flat = normal(face);
  const auto weights = weights_at(t, x);
  Vec3d bulge;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d normal = all.normals[all.corners[face][i].normal];
    if (dot(normal, flat) < least_cosine) return {};
    const double below = -side * dot(x - t[i], normal);
    if (below > 0.0) bulge += normal * (side * below * weights[i]);
  }
  return bulge;
}

double Mesh::clearance(const Segment& segment) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t face = 0; face < triangle_count(); ++face)
    least = std::fmin(least, polygon_clearance(triangle(face), normal(face), segment));
  return least;
}

Vec3d Mesh::center_of_mass() const {
  const Vec3d middle = triangle_count() > 0 ? bounds().middle() : Vec3d{};
  Vec3d by_area, by_volume;
  double area = 0.0, volume = 0.0;
  for (std::uint32_t face = 0; face < triangle_count(); ++face) {
    const auto t = triangle(face);
    const Vec3d a = t[0] - middle, b = t[1] - middle, c = t[2] - middle;
    const double share = length(area_vector(t)), wedge = dot(a, cross(b, c));
    area += share, volume += wedge;
    by_area += (a + b + c) * (share / 3.0);
    by_volume += (a + b + c) * (wedge / 4.0);
  }
  const double size = bounds().diagonal();
  if (closed() && std::fabs(volume) > 1e-9 * size * area) return middle + by_volume / volume;
  return area > 0.0 ? middle + by_area / area : middle;
}

double Mesh::area() const { return triangle_count() == 0 ? 0.0 : data_->area_up_to.back(); }

SurfacePoint Mesh::sample(double u1, double u2) const {
  const auto& sums = data_->area_up_to;
  const double at = u1 * sums.back();
  const auto found = std::min<std::size_t>(
      std::upper_bound(sums.begin(), sums.end(), at) - sums.begin(), sums.size() - 1);
  const auto face = static_cast<std::uint32_t>(found);
  const double before = face == 0 ? 0.0 : sums[face - 1];
  const double share = std::clamp((at - before) / (sums[face] - before), 0.0, 1.0);
  const double from_corner = std::sqrt(share);
  const auto t = triangle(face);
  const Vec3d x =
      t[0] + (t[1] - t[0]) * (from_corner * (1.0 - u2)) + (t[2] - t[0]) * (from_corner * u2);
  return surface_at(x, face);
}

}  // namespace portalens
