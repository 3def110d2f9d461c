// Meshes: their normals, materials, placement, and whether they are closed.
#include "geometry/mesh.h"

#include <gtest/gtest.h>

#include <limits>

#include "geometry/samples.h"
#include "support/infinity.h"
#include "support/scale.h"

namespace portalens::test {
namespace {

TEST(Mesh, InterpolatesNormalsAndKeepsTheGeometricOnes) {
  const Mesh smooth(globe(8, {}, 1, true)), flat(globe(8, {}, 1, false));
  Random random(1);
  for (int i = 0; i < scaled(1000); ++i) {
    const Ray ray{random.point(0.2), random.direction()};
    const auto hit = smooth.intersect(ray, 0, infinity);
    ASSERT_TRUE(hit.has_value());
    const Vec3d x = ray.at(hit->distance);
    const auto a = smooth.surface_at(x, hit->face), b = flat.surface_at(x, hit->face);
    EXPECT_LT(length(a.normal - normalize(x)), 0.05);
    EXPECT_EQ(a.geometric_normal, b.normal);
    EXPECT_NEAR(dot(a.normal, a.normal), 1, 1e-12);
  }
}

TEST(Mesh, LeavesOutUnsoundTrianglesAndTheirMaterials) {
  Triangles triangles = crate({0, 0, 0}, {1, 1, 1});
  for (std::uint32_t i = 0; i < 12; ++i) triangles.material_of.push_back(i);
  triangles.corners[3][1] = triangles.corners[3][0];  // no area
  triangles.corners[5][2].position = 99;              // no such vertex
  const Mesh mesh(triangles);
  EXPECT_EQ(mesh.triangle_count(), 10u);
  EXPECT_EQ(mesh.material_of(2), 2u);
  EXPECT_EQ(mesh.material_of(3), 4u);
  EXPECT_EQ(mesh.material_of(4), 6u);
  triangles.positions[0].x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_LT(Mesh(triangles).triangle_count(), 10u);
  EXPECT_FALSE(Mesh(crate({0, 0, 0}, {1, 1, 1})).material_of(0).has_value());
}

TEST(Mesh, IsClosedOnlyIfEveryEdgeHasTwoOppositeTriangles) {
  EXPECT_TRUE(Mesh(crate({0, 0, 0}, {1, 1, 1})).closed());
  EXPECT_TRUE(Mesh(globe(6, {}, 1, true)).closed()) << "poles and seams share positions";
  Triangles open = crate({0, 0, 0}, {1, 1, 1});
  open.corners.pop_back();
  EXPECT_FALSE(Mesh(open).closed());
  Triangles flipped = crate({0, 0, 0}, {1, 1, 1});
  std::swap(flipped.corners[4][0], flipped.corners[4][1]);
  EXPECT_FALSE(Mesh(flipped).closed());
  Triangles doubled = crate({0, 0, 0}, {1, 1, 1});
  doubled.corners.insert(doubled.corners.end(), doubled.corners.begin(), doubled.corners.end());
  EXPECT_FALSE(Mesh(doubled).closed());
  EXPECT_FALSE(Mesh().closed());
}

TEST(Mesh, ItsCentreOfMassIsOfTheVolumeIfClosedElseOfTheArea) {
  Triangles crate_with_fine_side = crate({10, 0, 0}, {12, 1, 1});
  EXPECT_LT(length(Mesh(crate_with_fine_side).center_of_mass() - Vec3d{11, 0.5, 0.5}), 1e-12);
  crate_with_fine_side.corners.erase(crate_with_fine_side.corners.begin(),
                                     crate_with_fine_side.corners.begin() + 2);  // the side at -x
  // Five sides: 1 at x = 12, four of area 2 with their middles at x = 11.
  EXPECT_LT(length(Mesh(crate_with_fine_side).center_of_mass() - Vec3d{11 + 1.0 / 9, 0.5, 0.5}),
            1e-12);
}

TEST(Mesh, IsScaledThenTurnedAboutItsMiddleThenMoved) {
  Table table{"mesh", {}, {}};
  const auto triple = [](double x, double y, double z) {
    return Value{Value::List{Value{x, {}}, Value{y, {}}, Value{z, {}}}, {}};
  };
  table.set("file", Value{std::string("crate.obj"), {}});
  table.set("translate", triple(5, 6, 7));
  table.set("rotation", triple(0, 0, 90));
  table.set("scale", triple(2, 1, 1));
  Faults faults;
  Parameters parameters(table, faults);
  const Mesh empty = Mesh::from(parameters);
  parameters.finish();
  EXPECT_TRUE(faults.empty());
  EXPECT_EQ(empty.file(), "crate.obj");
  EXPECT_EQ(empty.triangle_count(), 0u);
  EXPECT_FALSE(empty.intersect({{0, 0, 0}, {1, 0, 0}}, 0, infinity).has_value());
  const Mesh mesh = empty.loaded(crate({0, 0, 0}, {2, 1, 1}));
  // Scaled it spans 4, 1, 1 about (2, 0.5, 0.5); turned 1, 4, 1.
  const Box box = mesh.bounds();
  EXPECT_LT(length(box.low - Vec3d{6.5, 4.5, 7}), 1e-12);
  EXPECT_LT(length(box.high - Vec3d{7.5, 8.5, 8}), 1e-12);
  EXPECT_TRUE(mesh.closed());
  EXPECT_NEAR(mesh.area(), 2 * (4 + 4 + 1), 1e-12);
}

TEST(Mesh, StretchedNormalsStayAtRightAnglesToTheSurface) {
  Table table{"mesh", {}, {}};
  table.set("file", Value{std::string("globe.obj"), {}});
  table.set("scale", Value{Value::List{Value{3.0, {}}, Value{1.0, {}}, Value{0.5, {}}}, {}});
  Faults faults;
  Parameters parameters(table, faults);
  const Mesh mesh = Mesh::from(parameters).loaded(globe(60, {}, 1, true));
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    const SurfacePoint point = mesh.sample(random.uniform(0, 1), random.uniform(0, 1));
    EXPECT_GT(dot(point.normal, point.geometric_normal), 0.98);
  }
}

}  // namespace
}  // namespace portalens::test
