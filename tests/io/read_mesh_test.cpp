// An ordinary mesh is read exactly or refused by line; what others write is taken.
#include "io/read_mesh.h"

#include <gtest/gtest.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "support/random.h"
#include "support/temporary_folder.h"

namespace portalens::test {
namespace {

MeshFile good_mesh(const std::string& text, const std::string& mtl = "") {
  const TemporaryFolder folder;
  if (!mtl.empty()) folder.write("a.mtl", mtl);
  Faults faults;
  MeshFile mesh = read_mesh(folder.write("a.obj", text), {}, FileMaterials::read, faults);
  EXPECT_NO_THROW(faults.raise());
  return mesh;
}

std::vector<Fault> faults_of(const std::string& text, const std::string& mtl = "") {
  const TemporaryFolder folder;
  if (!mtl.empty()) folder.write("a.mtl", mtl);
  Faults faults;
  const MeshFile mesh = read_mesh(folder.write("a.obj", text), {}, FileMaterials::read, faults);
  EXPECT_EQ(mesh.triangles.corners.empty(), !faults.empty());
  try {
    faults.raise();
  } catch (const SceneError& error) {
    return error.faults();
  }
  return {};
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

TEST(Mesh, MaterialsAreReadAsOtherProgramsWriteThem) {
  const std::string square = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const std::string red = "newmtl red\nKd 1 0 0\n",
                    green = "NEWMTL\nKD 0 0.5 0\nMap_kd -s 1 1 1 -bm 2 a b.png\n";
  struct Case {
    std::string obj;
    std::size_t materials, warnings;
  };
  const Case cases[] = {
      {"mtllib a.mtl b.mtl\n" + square + "usemtl red\nf 1 2 3\nusemtl\nf 1 2 3\n", 2, 0},
      {"mtllib a.mtl\nmtllib a.mtl\n" + square + "usemtl red\nf 1 2 3\n", 1, 0},
      {"mtllib sub\\c.mtl\n" + square + "usemtl red\nf 1 2 3\n", 1, 0},
      {"mtllib two words.mtl\n" + square + "usemtl red\nf 1 2 3\n", 1, 0},
      {"MTLLIB a.mtl\n" + square + "UseMtl red\nf 1 2 3\n", 1, 0},
      {"mtllib none.mtl\n" + square + "usemtl gone\nf 1 2 3\n", 0, 1},
      {square + "usemtl (null)\nf 1 2 3\nusemtl (null)\nf 1 2 3\n", 0, 1},
      {"mtllib a.mtl\n" + square + "usemtl red\nf 1 2 3\nusemtl None\nf 1 2 3\n", 2, 1},
      {"mtllib a.mtl\nmtllib sub/c.mtl\n" + square + "usemtl red\nf 1 2 3\n", 1, 1},
      {"mtllib d.mtl\n" + square + "usemtl red\nf 1 2 3\n", 1, 1},
      {"mtllib e.mtl\n" + square + "usemtl red\nf 1 2 3\n", 1, 2}};
  for (const Case& one : cases) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.path() / "sub");
    for (const char* name : {"a.mtl", "sub/c.mtl", "two words.mtl"}) folder.write(name, red);
    folder.write("b.mtl", green);
    folder.write("d.mtl", red + "map_Kd -o 0.5 0 -clamp off -colorspace sRGB a.png\n");
    folder.write("e.mtl", red + "map_Kd -warp 2 -s 2 2 1 a.png\n");
    Faults faults;
    const auto file = folder.write("a.obj", one.obj);
    const MeshFile mesh = read_mesh(file, {}, FileMaterials::read, faults);
    EXPECT_NO_THROW(faults.raise()) << one.obj;
    EXPECT_EQ(mesh.materials.size(), one.materials) << one.obj;
    EXPECT_EQ(mesh.warnings.size(), one.warnings) << one.obj;
    const MeshFile bare = read_mesh(file, {}, FileMaterials::passed_over, faults);
    EXPECT_TRUE(faults.empty() && bare.materials.empty() && bare.warnings.empty()) << one.obj;
    EXPECT_EQ(bare.triangles.corners.size(), mesh.triangles.corners.size());
  }
}

TEST(Mesh, OptionsOfMapsAreToldFromTheNameThatFollows) {
  const MeshFile mesh =
      good_mesh("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n",
                "newmtl a\nmap_Kd -s 1 1 1 -mm 0 1 -blendu on -type sphere old wood.png\n");
  EXPECT_EQ(std::get<std::string>(mesh.materials[0].find("diffuse")->data), "old wood.png");
}

TEST(Mesh, WarningsAreFewHoweverManyCausesThereAre) {
  std::string many = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (int i = 0; i < 1000; ++i)
    many +=
        "mtllib none" + std::to_string(i) + ".mtl\nusemtl m" + std::to_string(i) + "\nf 1 2 3\n";
  const MeshFile mesh = good_mesh(many);
  ASSERT_EQ(mesh.warnings.size(), 21U);
  EXPECT_EQ(mesh.warnings.back().problem, "980 more things are passed over or replaced");
}

TEST(Mesh, AMaterialThatIsMissingIsToldOnce) {
  std::string many = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (int i = 0; i < 100'000; ++i) many += "usemtl x\nf 1 2 3\n";
  const MeshFile mesh = good_mesh(many);
  EXPECT_EQ(mesh.triangles.corners.size(), 100'000U);
  ASSERT_EQ(mesh.warnings.size(), 1U);
  EXPECT_EQ(mesh.warnings[0].where.line, 4);
}

TEST(Mesh, StatementsThatSayNothingOfTheShapeArePassedOver) {
  const std::string some = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const MeshFile plain = good_mesh(
      "lod 2\nbevel on\nc_interp off\nd_interp off\nmg 0\nvp 0.5\n"
      "shadow_obj a\ntrace_obj a\nusemap off\nmaplib a\nt 1 2\nvw 1\n" +
      some);
  EXPECT_TRUE(plain.warnings.empty());
  const MeshFile curved = good_mesh(some + "cstype bezier\ndeg 3\ncurv 0 1 1 2 3\nend\n");
  ASSERT_EQ(curved.warnings.size(), 1U);
  EXPECT_EQ(curved.warnings[0].where.line, 5);
  EXPECT_EQ(curved.triangles.corners.size(), 1U);
}

TEST(Mesh, ColoursOfVerticesAreToldOnce) {
  const std::string end = "f 1 2 3\n";
  for (const std::string more : {" 1 0 0", " 1 0.5 0.5 0.5"}) {
    const MeshFile mesh =
        good_mesh("v 0 0 0\nv 1 0 0" + more + "\nv 0 1 0" + more + "\nv 0 0 1" + more + "\n" + end);
    ASSERT_EQ(mesh.warnings.size(), 1U);
    EXPECT_EQ(mesh.warnings[0].problem, "the colours of its vertices are passed over");
    EXPECT_EQ(mesh.warnings[0].where.line, 2);
  }
  EXPECT_TRUE(good_mesh("v 0 0 0 1\nv 1 0 0 1\nv 0 1 0 1\n" + end).warnings.empty());
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
      {"mtllib ../a.mtl\n" + start + "f 1 2 3\n", 1, "leaves"},
      {"mtllib /etc/hostname\n" + start + "f 1 2 3\n", 1, "leaves"},
      {start + "curvy 0 1 1 2\nf 1 2 3\n", 4, "unknown statement 'curvy'"},
      {std::string("\xff\xfev\0 \0", 6), 0, "save it as UTF-8"},
      {std::string("\0v\0 \0001", 6), 0, "save it as UTF-8"},
      {std::string("\x89PNG\r\n\x1a\n\0\0", 10), 0, "this is no OBJ mesh"},
      {"[camera]\nposition = [0, 0, 1]\nv 1 2 3\n", 0, "this is no OBJ mesh"},
      {"vvv 0 0 0\n" + start + "f 1 2 3\n", 1, "unknown statement 'vvv'"},
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
                                               {"newmtl a\nmap_Kd -s 1 1\n", 2},
                                               {"\xfe\xff", 0},
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
