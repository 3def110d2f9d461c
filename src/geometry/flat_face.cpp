#include "geometry/flat_face.h"

#include <cmath>
#include <numbers>

namespace portalens {
namespace {

/// A polygon around a disc that lies across the y axis of its pose.
FlatFace disc(const Pose& pose, std::uint32_t face, double height, double radius) {
  constexpr int corners = 8;
  const double reach = radius / std::cos(std::numbers::pi / corners);
  FlatFace flat{face, pose.turned({0, height < 0.0 ? -1.0 : 1.0, 0}), {}};
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    flat.hull.push_back(pose.to_world({reach * std::cos(angle), height, reach * std::sin(angle)}));
  }
  return flat;
}

std::vector<FlatFace> faces_of(const Quad& quad) {
  return {{0, quad.normal(), {quad.vertices().begin(), quad.vertices().end()}}};
}

std::vector<FlatFace> faces_of(const Cube& cube) {
  std::vector<FlatFace> faces;
  const Vec3d h = cube.half();
  const auto add = [&](Vec3d normal, Vec3d middle, Vec3d a, Vec3d b) {
    FlatFace flat{static_cast<std::uint32_t>(faces.size()), cube.pose().turned(normal), {}};
    for (const Vec3d corner : {-a - b, a - b, a + b, b - a})
      flat.hull.push_back(cube.pose().to_world(middle + corner));
    faces.push_back(std::move(flat));
  };
  const Vec3d x{h.x, 0, 0}, y{0, h.y, 0}, z{0, 0, h.z};
  add({-1, 0, 0}, -x, y, z);
  add({1, 0, 0}, x, y, z);
  add({0, -1, 0}, -y, x, z);
  add({0, 1, 0}, y, x, z);
  add({0, 0, -1}, -z, x, y);
  add({0, 0, 1}, z, x, y);
  return faces;
}

std::vector<FlatFace> faces_of(const Cone& cone) {
  return {disc(cone.pose(), 1, -0.5 * cone.height(), cone.radius())};
}

std::vector<FlatFace> faces_of(const Cylinder& cylinder) {
  const double half = 0.5 * cylinder.height();
  return {disc(cylinder.pose(), 1, -half, cylinder.radius()),
          disc(cylinder.pose(), 2, half, cylinder.radius())};
}

std::vector<FlatFace> faces_of(const Ring& ring) {
  const double half = 0.5 * ring.height();
  return {disc(ring.pose(), 2, -half, ring.outer_radius()),
          disc(ring.pose(), 3, half, ring.outer_radius())};
}

std::vector<FlatFace> faces_of(const Sphere& /*sphere*/) { return {}; }
std::vector<FlatFace> faces_of(const Mesh& /*mesh*/) { return {}; }

}  // namespace

std::vector<FlatFace> flat_faces(const Shape& shape) {
  return std::visit([](const auto& s) { return faces_of(s); }, shape);
}

}  // namespace portalens
