// The mesh that benchmarks generate is what they take it for.
#include "support/bumpy_sphere.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "math/vec3.h"

namespace portalens::benchmarks {
namespace {

struct Parts {
  std::vector<Vec3d> vertices;
  std::vector<std::array<std::size_t, 3>> faces;

  explicit Parts(const std::string& text) {
    std::istringstream stream(text);
    std::string word;
    while (stream >> word) {
      if (word == "v") {
        Vec3d v;
        stream >> v.x >> v.y >> v.z;
        vertices.push_back(v);
      } else {
        std::array<std::size_t, 3> face{};
        stream >> face[0] >> face[1] >> face[2];
        faces.push_back(face);
      }
    }
  }
};

class BumpySphere : public testing::TestWithParam<int> {};

TEST_P(BumpySphere, HasAsManyTrianglesAsWereAskedForAndFewMore) {
  const Parts parts(bumpy_sphere(GetParam()));
  EXPECT_GE(parts.faces.size(), static_cast<std::size_t>(GetParam()));
  EXPECT_LE(parts.faces.size(), 2 * static_cast<std::size_t>(GetParam()));
}

TEST_P(BumpySphere, IsClosedAndFacesOutwards) {
  const Parts parts(bumpy_sphere(GetParam()));
  std::map<std::pair<std::size_t, std::size_t>, int> edges;
  for (const auto& face : parts.faces) {
    for (std::size_t i = 0; i < 3; ++i) ++edges[{face[i], face[(i + 1) % 3]}];
    const Vec3d a = parts.vertices.at(face[0] - 1), b = parts.vertices.at(face[1] - 1),
                c = parts.vertices.at(face[2] - 1);
    EXPECT_GT(dot(cross(b - a, c - a), a + b + c), 0.0);
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
  }
}

INSTANTIATE_TEST_SUITE_P(OfManySizes, BumpySphere, testing::Values(8, 100, 5000));

}  // namespace
}  // namespace portalens::benchmarks
