/// \file
/// Meshes whose normals are smooth, beside the sphere that they stand for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/samples.h"
#include "render/render.h"
#include "support/scene_text.h"

namespace portalens::test {
namespace {

std::string globe_as_obj(int bands) {
  const Triangles globe = test::globe(bands, {}, 1.0, true);
  std::string obj = "o globe\n";
  const auto line = [&](const char* word, Vec3d v) {
    obj += std::string(word) + " " + std::to_string(v.x) + " " + std::to_string(v.y) + " " +
           std::to_string(v.z) + "\n";
  };
  for (const Vec3d& v : globe.positions) line("v", v);
  for (const Vec3d& n : globe.normals) line("vn", n);
  for (const auto& corners : globe.corners) {
    obj += "f";
    for (const auto& corner : corners) {
      const std::string index = std::to_string(corner.position + 1);
      obj += " " + index + "//" + index;
    }
    obj += "\n";
  }
  return obj;
}

struct SmoothMesh : testing::Test {
  /// The same picture, of a mesh and of the sphere.
  void render_both(const std::string& scene) {
    const Folder folder;
    folder.write("globe.obj", globe_as_obj(16));
    const std::string head =
        "camera = { position = [0, 0, 6], look_at = [0, 0, 0], fov = 22 }\n"
        "film = { width = 96, height = 96 }\nsampler = { samples = 4 }\n" +
        scene;
    mesh = render(compiled(folder, head + "[[mesh]]\nfile = \"globe.obj\"\nmaterial = \"m\"\n"), {})
               .image;
    sphere = render(compiled(folder, head + "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\n"
                                            "material = \"m\"\n"),
                    {})
                 .image;
  }
  Image mesh, sphere;
};

TEST_F(SmoothMesh, HasTheTerminatorOfTheSphere) {
  for (const char* lamp : {"[[light]]\nposition = [4, 4, 1]\nintensity = [60, 60, 60]\n",
                           "[[light]]\nposition = [-5, 1, 0]\nintensity = [60, 60, 60]\n"}) {
    render_both(
        "environment = { color = [0, 0, 0] }\nshading = { ambient = [0, 0, 0] }\n"
        "material = [{ name = \"m\", diffuse = [0.8, 0.8, 0.8] }]\n" +
        std::string(lamp));
    float brightest = 0.0f;
    int away = 0, pixels = 0;
    for (int y = 0; y < 96; ++y)
      for (int x = 0; x < 96; ++x) {
        if (std::hypot(x - 47.5, y - 47.5) > 38) continue;  // within the silhouettes
        const float here = mesh.at(x, y)[0], there = sphere.at(x, y)[0];
        brightest = std::max(brightest, there);
        pixels += 1;
        away += std::fabs(here - there) > 0.03f * 0.8f ? 1 : 0;
      }
    EXPECT_GT(brightest, 0.3f);
    EXPECT_EQ(away, 0) << "of " << pixels;
  }
}

TEST_F(SmoothMesh, AMirrorOfAWhiteWorldIsAsWhiteAsItsShareAtTheRimToo) {
  render_both(
      "environment = { color = [1, 1, 1] }\n"
      "material = [{ name = \"m\", diffuse = [0, 0, 0], reflective = [0.95, 0.95, 0.95] }]\n");
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 96; ++x) EXPECT_GT(mesh.at(x, y)[0], 0.9499f) << x << ' ' << y;
}

}  // namespace
}  // namespace portalens::test
