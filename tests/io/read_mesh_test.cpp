// An ordinary mesh is read exactly or refused by line; polygons keep their area and their side.
#include "io/read_mesh.h"

#include <gtest/gtest.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "math/triangulate.h"
#include "support/random.h"
#include "support/scale.h"
#include "support/temporary_folder.h"

namespace portalens::test {
namespace {

constexpr double pi = 3.14159265358979323846;

MeshFile good_mesh(const std::string& text, const std::string& mtl = "") {
  const TemporaryFolder folder;
  if (!mtl.empty()) folder.write("a.mtl", mtl);
  Faults faults;
  MeshFile mesh = read_mesh(folder.write("a.obj", text), {}, faults);
  EXPECT_NO_THROW(faults.raise());
  return mesh;
}

std::vector<Fault> faults_of(const std::string& text, const std::string& mtl = "") {
  const TemporaryFolder folder;
  if (!mtl.empty()) folder.write("a.mtl", mtl);
  Faults faults;
  const MeshFile mesh = read_mesh(folder.write("a.obj", text), {}, faults);
  EXPECT_EQ(mesh.triangles.corners.empty(), !faults.empty());
  try {
    faults.raise();
  } catch (const SceneError& error) {
    return error.faults();
  }
  return {};
}

Vec3d area_of(const std::vector<Vec3d>& p, const std::array<std::size_t, 3>& t) {
  return cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]) * 0.5;
}

/// A simple polygon around the origin whose corners lie at ever larger angles.
std::vector<Vec3d> star(Random& random, std::size_t count) {
  std::vector<Vec3d> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * pi * static_cast<double>(i) / static_cast<double>(count);
    const double r = random.uniform(0.2, 1.0);
    points.push_back({r * std::cos(angle), r * std::sin(angle), 0.3 * r * std::cos(angle)});
  }
  return points;
}

TEST(Polygon, TrianglesHaveThePolygonsAreaAndItsSide) {
  Random random(1);
  for (int trial = 0; trial < scaled(200); ++trial) {
    const std::vector<Vec3d> points = star(random, 4 + static_cast<std::size_t>(trial) % 40);
    const auto triangles = triangulate(points);
    ASSERT_EQ(triangles.size(), points.size() - 2);
    Vec3d whole;
    for (std::size_t i = 0; i < points.size(); ++i) {
      whole += cross(points[i], points[(i + 1) % points.size()]) * 0.5;
    }
    Vec3d sum;
    for (const auto& triangle : triangles) {
      const Vec3d area = area_of(points, triangle);
      EXPECT_GE(dot(area, whole), 0.0);  // so that none overlap
      sum += area;
    }
    EXPECT_NEAR(length(sum - whole), 0.0, 1e-12);
  }
}

TEST(Polygon, AQuadIsCutInsideAndAlongItsShorterDiagonal) {
  const std::vector<Vec3d> kite{{0, 0, 0}, {1, -0.2, 0}, {2, 0, 0}, {1, 0.2, 0}};
  const auto triangles = triangulate(kite);
  EXPECT_EQ(triangles[0], (std::array<std::size_t, 3>{0, 1, 3}));
  const std::vector<Vec3d> dart{{0, 0, 0}, {2, -1, 0}, {0.5, 0, 0}, {2, 1, 0}};
  for (const auto& triangle : triangulate(dart)) EXPECT_GT(area_of(dart, triangle).z, 0.0);
}

TEST(Polygon, OneThatCrossesItselfOrHasNoAreaStillEnds) {
  Random random(2);
  for (std::size_t count = 4; count < 200; count += 7) {
    std::vector<Vec3d> points(count);
    EXPECT_EQ(triangulate(points).size(), count - 2);
    for (Vec3d& p : points) p = random.point(1.0);
    EXPECT_EQ(triangulate(points).size(), count - 2);
  }
}

TEST(Mesh, IsWhatAnotherReaderReads) {
  Random random(3);
  const auto any = [&] { return random.uniform(-10.0, 10.0); };
  std::ostringstream text;
  const int count = 60;
  for (int i = 0; i < count; ++i) {
    text << "v " << any() << ' ' << any() << ' ' << any() << "\nvt " << any() << ' ' << any()
         << "\nvn 0 0 " << i + 1 << "\n";
  }
  const auto one = [&] { return 1 + static_cast<int>(random.bits() % count); };
  for (int i = 0; i < 100; ++i) {
    text << 'f';
    for (int k = 0; k < 3; ++k) {
      text << ' ' << one() << '/' << -one() << '/' << one();
    }
    text << "\ng group" << i << "\ns " << i << "\n";
  }
  const MeshFile mesh = good_mesh(text.str());
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::istringstream stream(text.str());
  std::string said;
  ASSERT_TRUE(tinyobj::LoadObj(&attributes, &shapes, &materials, &said, &said, &stream));
  std::size_t at = 0;
  for (const auto& shape : shapes) {
    for (const auto& index : shape.mesh.indices) {
      const auto corner = mesh.triangles.corners.at(at / 3)[at % 3];
      const Vec3d p = mesh.triangles.positions[corner.position];
      EXPECT_NEAR(p.x, attributes.vertices[3 * index.vertex_index], 1e-5);
      EXPECT_NEAR(p.z, attributes.vertices[3 * index.vertex_index + 2], 1e-5);
      EXPECT_NEAR(mesh.triangles.uvs[corner.uv][1],
                  attributes.texcoords[2 * index.texcoord_index + 1], 1e-5);
      EXPECT_EQ(corner.normal, static_cast<std::uint32_t>(index.normal_index));
      ++at;
    }
  }
  EXPECT_EQ(at, 3 * mesh.triangles.corners.size());
}

TEST(Mesh, NumbersAreReadToTheLastBit) {
  const MeshFile mesh =
      good_mesh("v 0.1 -1e-3 +123456789.123456789\nv 1e-400 1 2\nv 1 2 3\nf 1 2 3\n");
  EXPECT_EQ(mesh.triangles.positions[0].x, 0.1);
  EXPECT_EQ(mesh.triangles.positions[0].y, -1e-3);
  EXPECT_EQ(mesh.triangles.positions[0].z, 123456789.123456789);
  EXPECT_EQ(mesh.triangles.positions[1].x, 0.0);
}

TEST(Mesh, NormalsAreOfLengthOneAndFlatWhereTheyAreMissing) {
  const MeshFile mesh = good_mesh(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 3 4\nvn 0 0 0\nf 1//1 2//1 3//1\nf 1 2 3\nf 1//2 2//1 "
      "3//1\n");
  const auto& triangles = mesh.triangles;
  for (const auto& triangle : triangles.corners) {
    for (const auto& corner : triangle)
      EXPECT_NEAR(length(triangles.normals.at(corner.normal)), 1.0, 1e-15);
  }
  EXPECT_EQ(triangles.normals[triangles.corners[1][0].normal], (Vec3d{0, 0, 1}));
  EXPECT_EQ(triangles.normals[triangles.corners[2][0].normal], (Vec3d{0, 0, 1}));
  EXPECT_NEAR(triangles.normals[triangles.corners[2][1].normal].y, 0.6, 1e-15);
}

TEST(Mesh, EveryIndexOfAGoodMeshIsInside) {
  const MeshFile mesh = good_mesh(
      "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nf 1/1 2/1 4/1 3/1\nf -1 -2 \\\n -3\n");
  ASSERT_EQ(mesh.triangles.corners.size(), 4U);
  EXPECT_TRUE(mesh.triangles.normals.empty());
  for (const auto& triangle : mesh.triangles.corners) {
    for (const auto& corner : triangle) {
      EXPECT_LT(corner.position, mesh.triangles.positions.size());
      EXPECT_LT(corner.uv, mesh.triangles.uvs.size());
    }
  }
}

TEST(Mesh, MaterialsBecomeOurs) {
  const MeshFile mesh = good_mesh(
      "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl red paint\nf 1 2 3\nusemtl lamp\n"
      "f 1 2 3\n",
      "newmtl red paint\nKa 1 1 1\nKd 1 0.5 0.25\nKs 0.5 0.5 0.5\nillum 2\nPr 0.25\n"
      "newmtl lamp\nKd 0.1\nKs 0.5 0.25 0\nKe 3 2 1\nillum 3\nmap_Kd sub\\wood grain.png\n");
  ASSERT_EQ(mesh.materials.size(), 3U);  // and a plain one for the first face
  EXPECT_EQ(mesh.triangles.material_of, (std::vector<std::uint32_t>{2, 0, 1}));
  const Table& red = mesh.materials[0];
  EXPECT_EQ(std::get<double>(std::get<Value::List>(red.find("diffuse")->data)[1].data), 0.5);
  EXPECT_EQ(std::get<double>(red.find("roughness")->data), 0.25);
  EXPECT_EQ(red.find("reflective"), nullptr);  // illum 2 mirrors nothing
  const Table& lamp = mesh.materials[1];
  EXPECT_EQ(std::get<std::string>(lamp.find("diffuse")->data), "sub/wood grain.png");
  EXPECT_EQ(std::get<double>(std::get<Value::List>(lamp.find("reflective")->data)[1].data), 0.25);
  EXPECT_EQ(std::get<double>(std::get<Value::List>(lamp.find("emitted")->data)[2].data), 1.0);
}

TEST(Mesh, EveryFaultIsToldWithItsLine) {
  const std::string start = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  struct Case {
    std::string text;
    int line;
    const char* phrase;
  };
  const Case cases[] = {
      {start + "f 1 2 4\n", 4, "does not have"},
      {start + "f 1 2 0\n", 4, "'0'"},
      {start + "f 1 2 -4\n", 4, "'-4'"},
      {start + "f 1 2 99999999999999999999\n", 4, "is not a corner"},
      {start + "f 1 2 4294967295\n", 4, "is not a corner"},
      {start + "f 1 2 4294967296\n", 4, "is not a corner"},
      {start + "f 1 2 three\n", 4, "'three'"},
      {start + "f 1 2\n", 4, "2 corners"},
      {start + "f\n", 4, "0 corners"},
      {start + "f 1/1 2/1 3/1\n", 4, "does not have"},
      {start + "f 1//1 2//1 3//1\n", 4, "does not have"},
      {start + "f 1/1/1/1 2 3\n", 4, "is not a corner"},
      {start + "v 0 nan 0\nf 1 2 3\n", 4, "'nan'"},
      {start + "v 0 inf 0\nf 1 2 3\n", 4, "'inf'"},
      {start + "v 0 1e300 0\nf 1 2 3\n", 4, "'1e300'"},
      {start + "v 0 word 0\nf 1 2 3\n", 4, "'word'"},
      {start + "v 0 0\nf 1 2 3\n", 4, "2 numbers"},
      {start + "vn 0 0\nf 1 2 3\n", 4, "2 numbers"},
      {start + "f 1 2 3\nf 1 2 3\nv 0.1 0.", 0, ""},
      {start + "f 1 2 3\nv 0.1 0.2", 5, "2 numbers"},
      {start + "f 1 2 3\nf 1 2", 5, "2 corners"},
      {start, 0, "no faces"},
      {"", 0, "no faces"},
      {start + "usemtl gold\nf 1 2 3\n", 4, "unknown material 'gold'"},
      {"mtllib nothere.mtl\n" + start + "f 1 2 3\n", 1, "no file"},
      {"mtllib ../a.mtl\n" + start + "f 1 2 3\n", 1, "leaves"},
      {"mtllib /etc/hostname\n" + start + "f 1 2 3\n", 1, "leaves"},
      {start + "curv 0 1 1 2\nf 1 2 3\n", 4, "unknown statement 'curv'"},
      {std::string("\x89PNG\r\n\x1a\n\0\0", 10), 1, "unknown statement"},
  };
  for (const Case& one : cases) {
    const auto faults = faults_of(one.text);
    if (*one.phrase == '\0') continue;
    ASSERT_FALSE(faults.empty()) << one.text;
    EXPECT_EQ(faults[0].where.line, one.line) << to_string(faults[0]);
    EXPECT_NE(to_string(faults[0]).find(one.phrase), std::string::npos) << to_string(faults[0]);
  }
}

TEST(Mesh, FaultsOfTheMaterialsAreToldInTheirOwnFile) {
  const std::string mesh = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const std::pair<const char*, int> cases[] = {{"newmtl a\nKd 1 nan 0\n", 2},
                                               {"newmtl a\nKd 1 2\n", 2},
                                               {"Kd 1 1 1\n", 1},
                                               {"newmtl a\n\nPr rough\n", 3},
                                               {"newmtl a\nillum 2.5\n", 2},
                                               {"newmtl a\nmap_Kd -s 2 2 1 a.png\n", 2},
                                               {"newmtl\n", 1},
                                               {"newmtl a\nnewmtl a\n", 2},
                                               {"newmtl a\nKd spectral f.rfl\n", 2}};
  for (const auto& [mtl, line] : cases) {
    const auto faults = faults_of(mesh, mtl);
    ASSERT_EQ(faults.size(), 1U) << mtl;
    EXPECT_EQ(faults[0].where.line, line) << mtl;
    EXPECT_NE(faults[0].where.file->find("a.mtl"), std::string::npos) << mtl;
  }
}

}  // namespace
}  // namespace portalens::test
