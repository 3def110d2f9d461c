#include "geometry/cube.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/clearance.h"
#include "geometry/extent.h"
#include "geometry/polygon.h"
#include "math/triangle_sample.h"

namespace portalens {
namespace {

/// The directions in which a face's texture coordinates grow, and its outward normal.
struct FaceAxes {
  Vec3d right, up, normal;
};
constexpr std::array<FaceAxes, 6> face_axes = {{{{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}},
                                                {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}},
                                                {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                                                {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
                                                {{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}},
                                                {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};

double extent(Vec3d axis, Vec3d half) {
  return std::fabs(axis.x) * half.x + std::fabs(axis.y) * half.y + std::fabs(axis.z) * half.z;
}

struct Solid {
  Vec3d half;

  [[nodiscard]] Vec3d closest(Vec3d p) const {
    return {std::clamp(p.x, -half.x, half.x), std::clamp(p.y, -half.y, half.y),
            std::clamp(p.z, -half.z, half.z)};
  }
  [[nodiscard]] double depth(Vec3d p) const {
    return std::min({half.x - std::fabs(p.x), half.y - std::fabs(p.y), half.z - std::fabs(p.z)});
  }
};

}  // namespace

Cube Cube::from(Parameters& parameters) {
  const Vec3d center = to_vec3(parameters.triple("center"));
  const Vec3d size = to_vec3(parameters.number_or_triple("size", positive));
  const Vec3d rotation = to_vec3(parameters.triple("rotation", any_number, Triple{}));
  const Cube cube(center, size, rotation);
  const double least = std::min({size.x, size.y, size.z});
  if (!extent_allowed(parameters, "size", cube.bounds(), least)) return {{}, {1, 1, 1}, {}};
  return cube;
}

Box Cube::bounds() const {
  const Vec3d x = pose_.turned({1, 0, 0}), y = pose_.turned({0, 1, 0}), z = pose_.turned({0, 0, 1});
  const Vec3d reach{extent({x.x, y.x, z.x}, half_), extent({x.y, y.y, z.y}, half_),
                    extent({x.z, y.z, z.z}, half_)};
  return {pose_.middle() - reach, pose_.middle() + reach};
}

std::optional<Contact> Cube::intersect(const Ray& world, double low, double high) const {
  const CenteredRay ray = pose_.to_local(world);
  NearestContact nearest(low, high);
  const double size = largest_component(half_);
  for (std::uint32_t face = 0; face < 6; ++face) {
    const FaceAxes& axes = face_axes[face];
    const double distance = (extent(axes.normal, half_) - dot(ray.origin, axes.normal)) /
                            dot(ray.direction, axes.normal);
    if (!std::isfinite(distance)) continue;
    const Vec3d hit = ray.at(distance);
    if (within(std::fabs(dot(hit, axes.right)), extent(axes.right, half_), size) &&
        within(std::fabs(dot(hit, axes.up)), extent(axes.up, half_), size))
      nearest.consider(ray.offset + distance, face);
  }
  return nearest.best();
}

SurfacePoint Cube::surface_at(Vec3d x, std::uint32_t face) const {
  const FaceAxes& axes = face_axes[face % 6];
  Vec3d local = pose_.to_local(x);
  local += axes.normal * (extent(axes.normal, half_) - dot(local, axes.normal));
  SurfacePoint point = pose_.point(local, axes.normal);
  const double width = 2.0 * extent(axes.right, half_), height = 2.0 * extent(axes.up, half_);
  point.flat = true;
  point.along = std::clamp(dot(local, axes.right) + 0.5 * width, 0.0, width);
  point.across = std::clamp(dot(local, axes.up) + 0.5 * height, 0.0, height);
  point.u = point.along / width;
  point.v = point.across / height;
  return point;
}

double Cube::clearance(const Segment& segment) const {
  return convex_clearance(Solid{half_}, pose_.to_local(segment.a), pose_.to_local(segment.b));
}

double Cube::area() const {
  return 8.0 * (half_.x * half_.y + half_.y * half_.z + half_.z * half_.x);
}

SurfacePoint Cube::sample(double u1, double u2) const {
  double at = u1 * area();
  for (std::uint32_t face = 0;; ++face) {
    const FaceAxes& axes = face_axes[face];
    const double width = 2.0 * extent(axes.right, half_), height = 2.0 * extent(axes.up, half_);
    const double share = std::min(1.0, at / (width * height));
    if (share < 1.0 || face == 5) {
      const Vec3d local = axes.normal * extent(axes.normal, half_) +
                          axes.right * (width * (share - 0.5)) + axes.up * (height * (u2 - 0.5));
      return surface_at(pose_.to_world(local), face);
    }
    at -= width * height;
  }
}

/// From outside those faces are seen that look at x, from inside all.
SeenSurface Cube::sample_seen(Vec3d x, double u1, double u2) const {
  const Vec3d local = pose_.to_local(x);
  const bool inside = Solid{half_}.depth(local) >= 0.0;
  std::array<TriangleCorners, 12> triangles;
  std::array<std::uint32_t, 6> faces;
  std::size_t seen = 0;
  for (std::uint32_t face = 0; face < 6; ++face) {
    const FaceAxes& axes = face_axes[face];
    const Vec3d middle = axes.normal * extent(axes.normal, half_);
    if (!inside && !(dot(local - middle, axes.normal) > 0.0)) continue;
    const Vec3d right = axes.right * extent(axes.right, half_);
    const Vec3d up = axes.up * extent(axes.up, half_);
    const Vec3d first = middle - right - up, opposite = middle + right + up;
    triangles[2 * seen] = {first, middle + right - up, opposite};
    triangles[2 * seen + 1] = {first, opposite, middle - right + up};
    faces[seen++] = face;
  }
  const auto [position, solid_angle, which] =
      sample_triangles(std::span(triangles).first(2 * seen), local, u1, u2);
  return {surface_at(pose_.to_world(position), faces[which / 2]), solid_angle};
}

std::vector<FlatFace> Cube::flat_faces() const {
  std::vector<FlatFace> faces;
  const auto add = [&](Vec3d normal, Vec3d middle, Vec3d a, Vec3d b) {
    FlatFace flat{static_cast<std::uint32_t>(faces.size()), pose_.turned(normal), {}};
    for (const Vec3d corner : {-a - b, a - b, a + b, b - a})
      flat.hull.push_back(pose_.to_world(middle + corner));
    faces.push_back(std::move(flat));
  };
  const Vec3d x{half_.x, 0, 0}, y{0, half_.y, 0}, z{0, 0, half_.z};
  add({-1, 0, 0}, -x, y, z);
  add({1, 0, 0}, x, y, z);
  add({0, -1, 0}, -y, x, z);
  add({0, 1, 0}, y, x, z);
  add({0, 0, -1}, -z, x, y);
  add({0, 0, 1}, z, x, y);
  return faces;
}

}  // namespace portalens
