#include "geometry/quad.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "geometry/extent.h"
#include "geometry/polygon.h"
#include "math/triangle_sample.h"

namespace portalens {
namespace {

constexpr std::array<TextureCoordinates, 4> default_coordinates = {
    {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}};
constexpr std::array<Vec3d, 4> unit_square = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};

double cross2(const TextureCoordinates& a, const TextureCoordinates& b) {
  return a[0] * b[1] - a[1] * b[0];
}

/// Twice the area, along the normal (Newell).
Vec3d twice_area(std::span<const Vec3d> v) {
  Vec3d sum;
  for (std::size_t i = 1; i + 1 < v.size(); ++i) sum += cross(v[i] - v[0], v[i + 1] - v[0]);
  return sum;
}

struct Edges {
  double shortest = std::numeric_limits<double>::infinity(), longest = 0.0;
};

Edges edges_of(std::span<const Vec3d> v) {
  Edges edges;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const double edge = length(v[(i + 1) % v.size()] - v[i]);
    edges = {std::fmin(edges.shortest, edge), std::fmax(edges.longest, edge)};
  }
  return edges;
}

/// Faults of shape are added at `vertices`.
bool is_sound(Parameters& parameters, std::span<const Vec3d> v) {
  Box box;
  for (const Vec3d& vertex : v) box.add(vertex);
  const Edges edges = edges_of(v);
  if (!extent_allowed(parameters, "vertices", box, edges.longest)) return false;
  const Vec3d area = twice_area(v);
  const double most = edges.longest * edges.longest;
  if (!(edges.shortest > 1e-9 * edges.longest) || !(length(area) > 1e-9 * most)) {
    parameters.fault("vertices", "the " + parameters.kind() + " has no area",
                     "give vertices that are all apart, not on one line, and in order around the "
                     "outline");
    return false;
  }
  const Vec3d normal = normalize(area);
  for (const Vec3d& vertex : v)
    if (!(std::fabs(dot(vertex - v[0], normal)) <= 1e-6 * edges.longest)) {
      parameters.fault("vertices", "the vertices are not in one plane",
                       "move them into one plane, to 1e-6 of the longest edge");
      return false;
    }
  for (std::size_t i = 0; i < v.size(); ++i) {
    const Vec3d next = v[(i + 1) % v.size()], last = v[(i + 2) % v.size()];
    const double turn = dot(cross(next - v[i], last - next), normal);
    if (!(turn > 1e-9 * edges.longest * edges.shortest)) {
      parameters.fault("vertices",
                       "the " + parameters.kind() + " is not convex at vertex " +
                           std::to_string((i + 1) % v.size()),
                       "give the vertices in order around a convex outline");
      return false;
    }
  }
  return true;
}

std::optional<double> number_in(const Value& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value.data))
    return static_cast<double>(*whole);
  const auto* number = std::get_if<double>(&value.data);
  return number && std::isfinite(*number) ? std::optional(*number) : std::nullopt;
}

std::vector<TextureCoordinates> read_coordinates(Parameters& parameters, std::size_t count) {
  const Value* value = parameters.raw("texture_coordinates");
  if (!value) return {};
  std::vector<TextureCoordinates> read;
  if (const auto* list = std::get_if<Value::List>(&value->data))
    for (const Value& element : *list) {
      const auto* pair = std::get_if<Value::List>(&element.data);
      const bool two = pair && pair->size() == 2;
      const auto u = two ? number_in((*pair)[0]) : std::nullopt;
      const auto v = two ? number_in((*pair)[1]) : std::nullopt;
      if (u && v) read.push_back({*u, *v});
    }
  const auto* list = std::get_if<Value::List>(&value->data);
  if (list && read.size() == list->size() && read.size() == count) return read;
  parameters.fault("texture_coordinates", "texture_coordinates don't fit the vertices",
                   "give a list of " + std::to_string(count) + " pairs [u, v], one a vertex");
  return {};
}

/// (u, v) with p = u e + v f + u v g, nearest to [0, 1]²; after Quilez, "Inverse bilinear
/// interpolation".
TextureCoordinates inverse_bilinear(TextureCoordinates p, TextureCoordinates e,
                                    TextureCoordinates f, TextureCoordinates g) {
  const double a = cross2(g, f), b = cross2(e, f) + cross2(p, g), c = cross2(p, e);
  // cross2(p - v f, e + v g) = 0 is a v² + b v + c = 0
  double v = std::numeric_limits<double>::infinity();
  if (a == 0.0) {  // a parallelogram
    if (const double only = c / -b; std::isfinite(only)) v = only;
  } else {
    const double root = std::sqrt(std::fmax(0.0, b * b - 4.0 * a * c));
    const double q = -0.5 * (b < 0.0 ? b - root : b + root);
    for (const double candidate : {c / q, q / a})
      if (std::isfinite(candidate) && std::fabs(candidate - 0.5) < std::fabs(v - 0.5))
        v = candidate;
  }
  v = std::clamp(v, 0.0, 1.0);
  const TextureCoordinates along = {e[0] + g[0] * v, e[1] + g[1] * v};
  const TextureCoordinates rest = {p[0] - f[0] * v, p[1] - f[1] * v};
  const double square = along[0] * along[0] + along[1] * along[1];
  const double u = (rest[0] * along[0] + rest[1] * along[1]) / square;
  return {std::isfinite(u) ? std::clamp(u, 0.0, 1.0) : 0.0, v};
}

}  // namespace

Quad Quad::from(Parameters& parameters) {
  std::vector<Vec3d> vertices;
  for (const Triple& point : parameters.points("vertices", 3, 4))
    vertices.push_back(to_vec3(point));
  const std::size_t count = vertices.empty() ? 4 : vertices.size();
  const auto coordinates = read_coordinates(parameters, count);
  if (vertices.empty() || !is_sound(parameters, vertices)) return Quad(unit_square);
  return Quad(vertices, coordinates);
}

Quad::Quad(std::span<const Vec3d> vertices, std::span<const TextureCoordinates> coordinates)
    : texture_coordinates_(default_coordinates), count_(vertices.size()) {
  std::copy(vertices.begin(), vertices.end(), vertices_.begin());
  std::copy(coordinates.begin(), coordinates.end(), texture_coordinates_.begin());
  normal_ = normalize(twice_area(vertices));
  const Vec3d edge = vertices[1] - vertices[0];
  right_ = normalize(edge - normal_ * dot(edge, normal_));
  up_ = cross(normal_, right_);
  first_edge_ = flat(edge);
  last_edge_ = flat(vertices[count_ - 1] - vertices[0]);
  if (count_ == 4) skew_ = flat(vertices[0] - vertices[1] + (vertices[2] - vertices[3]));
}

Box Quad::bounds() const {
  Box box;
  for (const Vec3d& vertex : vertices()) box.add(vertex);
  return box;
}

std::optional<Contact> Quad::intersect(const Ray& ray, double low, double high) const {
  const auto distance = line_through_polygon(vertices(), normal_, ray);
  if (!distance || !(*distance >= low && *distance <= high)) return std::nullopt;
  return Contact{*distance, 0};
}

TextureCoordinates Quad::own_coordinates(TextureCoordinates p) const {
  const TextureCoordinates &e = first_edge_, &f = last_edge_;
  if (count_ == 4) return inverse_bilinear(p, e, f, skew_);
  const double second = std::clamp(cross2(p, f) / cross2(e, f), 0.0, 1.0);
  const double third = std::clamp(cross2(e, p) / cross2(e, f), 0.0, 1.0 - second);
  return {second, third};
}

SurfacePoint Quad::surface_at(Vec3d x, std::uint32_t) const {
  SurfacePoint point = place_at(x);
  const auto [s, t] = own_coordinates({point.along, point.across});
  const std::array<double, 4> weights =
      count_ == 4
          ? std::array<double, 4>{(1.0 - s) * (1.0 - t), s * (1.0 - t), s * t, (1.0 - s) * t}
          : std::array<double, 4>{1.0 - s - t, s, t, 0.0};
  for (std::size_t i = 0; i < count_; ++i) {
    point.u += weights[i] * texture_coordinates_[i][0];
    point.v += weights[i] * texture_coordinates_[i][1];
  }
  return point;
}

double Quad::clearance(const Segment& segment) const {
  return polygon_clearance(vertices(), normal_, segment);
}

Vec3d Quad::center_of_mass() const {
  Vec3d sum;
  for (const Vec3d& vertex : vertices()) sum += vertex - vertices_[0];
  return vertices_[0] + sum / static_cast<double>(count_);
}

double Quad::area() const { return 0.5 * length(twice_area(vertices())); }

SurfacePoint Quad::sample(double u1, double u2) const {
  const auto half = [&](std::size_t i) {
    return length(cross(vertices_[i] - vertices_[0], vertices_[i + 1] - vertices_[0]));
  };
  const double first = half(1), second = count_ == 4 ? half(2) : 0.0;
  double at = u1 * (first + second);
  const std::size_t i = at < first || count_ == 3 ? 1 : 2;
  const double share = std::min(1.0, i == 1 ? at / first : (at - first) / second);
  const double from_corner = std::sqrt(share);
  const Vec3d x = vertices_[0] + (vertices_[i] - vertices_[0]) * (from_corner * (1.0 - u2)) +
                  (vertices_[i + 1] - vertices_[0]) * (from_corner * u2);
  return surface_at(x, 0);
}

SeenSurface Quad::sample_seen(Vec3d x, double u1, double u2) const {
  const std::array<TriangleCorners, 2> halves = {
      {{vertices_[0], vertices_[1], vertices_[2]}, {vertices_[0], vertices_[2], vertices_[3]}}};
  const SeenPoint seen = sample_triangles(std::span(halves).first(count_ - 2), x, u1, u2);
  return {surface_at(seen.position, 0), seen.solid_angle};
}

std::vector<FlatFace> Quad::flat_faces() const {
  return {{0, normal_, {vertices_.begin(), vertices_.begin() + static_cast<int>(count_)}}};
}

}  // namespace portalens
