// Normals by vertex: smooth over gentle edges, and flat beside sharp ones.
#include "math/smooth_normals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/mesh.h"
#include "geometry/samples.h"

namespace portalens::test {
namespace {

Triangles smoothed(Triangles mesh, double crease) {
  smooth_normals(mesh, crease);
  return mesh;
}

/// Two squares that meet along x = 0, the second one bent down by so many degrees.
Triangles roof(double degrees) {
  const double bend = degrees * std::numbers::pi / 180.0, x = std::cos(bend), y = -std::sin(bend);
  Triangles roof;
  roof.positions = {{-1, 0, 1}, {0, 0, 1}, {0, 0, 0}, {-1, 0, 0}, {x, y, 1}, {x, y, 0}};
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    roof.corners.push_back({{{a, 0, 0}, {b, 0, 0}, {c, 0, 0}}});
  };
  add(0, 1, 2), add(0, 2, 3), add(1, 4, 5), add(1, 5, 2);
  return roof;
}

/// Of a corner; of a flat triangle the triangle's own.
Vec3d normal_at(const Triangles& mesh, std::size_t face, std::size_t corner) {
  const auto& c = mesh.corners[face];
  const Vec3d said = mesh.normals[c[corner].normal];
  const Vec3d a = mesh.positions[c[0].position];
  return said == Vec3d{} ? normalize(cross(mesh.positions[c[1].position] - a,
                                           mesh.positions[c[2].position] - a))
                         : said;
}

TEST(SmoothNormals, OfASpherePointFromItsMiddleAlsoAtPolesAndSeams) {
  Triangles sphere = globe(24, {1, 2, 3}, 2.0, false);
  for (auto& corners : sphere.corners)  // a file that shares no vertex
    for (auto& corner : corners) {
      sphere.positions.push_back(sphere.positions[corner.position]);
      corner.position = static_cast<std::uint32_t>(sphere.positions.size() - 1);
    }
  const Mesh mesh(smoothed(sphere, 40));
  for (std::uint32_t face = 0; face < mesh.triangle_count(); ++face)
    for (const Vec3d& corner : mesh.triangle(face))
      EXPECT_GT(dot(mesh.surface_at(corner, face).normal, normalize(corner - Vec3d{1, 2, 3})),
                0.9999);
}

TEST(SmoothNormals, OfACubeAreThoseOfItsFaces) {
  const Mesh cube(smoothed(crate({0, 0, 0}, {1, 2, 3}), 40));
  for (std::uint32_t face = 0; face < cube.triangle_count(); ++face)
    for (const Vec3d& corner : cube.triangle(face)) {
      const SurfacePoint point = cube.surface_at(corner, face);
      EXPECT_LT(length(point.normal - point.geometric_normal), 1e-15);
    }
}

TEST(SmoothNormals, AnEdgeIsSmoothUpToTheCreaseAngle) {
  const Vec3d up{0, 1, 0};
  for (const auto& [bend, crease, smooth] : {std::tuple{30.0, 40.0, true},
                                             {39.0, 40.0, true},
                                             {41.0, 40.0, false},
                                             {90.0, 89.0, false},
                                             {90.0, 91.0, true}}) {
    const Triangles mesh = smoothed(roof(bend), crease);
    EXPECT_EQ(dot(normal_at(mesh, 0, 2), up) < 0.999, smooth) << bend << " by " << crease;
    EXPECT_NEAR(dot(normal_at(mesh, 0, 0), up), 1.0, 1e-12) << "far from the edge";
  }
  const Triangles mesh = smoothed(roof(30), 40);
  EXPECT_NEAR(dot(normal_at(mesh, 0, 2), up), std::cos(std::numbers::pi / 12), 1e-12)
      << "as much of each side as its angle there";
}

TEST(SmoothNormals, AnEdgeOfMoreThanTwoTrianglesOrOfOneTurnedOverIsSharp) {
  Triangles three = roof(10), turned = roof(10);
  three.positions.push_back({0, 1, 0.5});
  three.corners.push_back({{{1, 0, 0}, {2, 0, 0}, {6, 0, 0}}});
  std::swap(turned.corners[2][0], turned.corners[2][1]);
  std::swap(turned.corners[3][0], turned.corners[3][1]);
  for (const Triangles& mesh : {smoothed(three, 40), smoothed(turned, 40)})
    EXPECT_NEAR(normal_at(mesh, 0, 2).y, 1.0, 1e-12);
}

TEST(SmoothNormals, AMeshThatHasNormalsKeepsThem) {
  const Triangles before = globe(6, {}, 1, true), after = smoothed(before, 40);
  EXPECT_EQ(after.normals, before.normals);
}

TEST(SmoothNormals, TrianglesWithoutAnAreaDoNoHarm) {
  Triangles mesh = roof(20);
  mesh.corners.insert(mesh.corners.begin(), {{{1, 0, 0}, {2, 0, 0}, {2, 0, 0}}});
  mesh = smoothed(mesh, 40);
  EXPECT_LT(normal_at(mesh, 1, 2).y, 0.999);
  for (const Vec3d& normal : mesh.normals) EXPECT_TRUE(is_finite(normal));
}

}  // namespace
}  // namespace portalens::test
