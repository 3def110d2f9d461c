/// \file
/// The picture of a model that is rendered without a scene.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "io/override.h"
#include "io/read_scene.h"
#include "render/render.h"
#include "support/scene_folder.h"
#include "world/compile.h"

namespace portalens {
namespace {

const std::string cube =
    "v -1 -1 -1\nv -1 -1 1\nv -1 1 -1\nv -1 1 1\nv 1 -1 -1\nv 1 -1 1\nv 1 1 -1\nv 1 1 1\n"
    "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n";

/// Of the pixels that show the model, the red.
std::vector<float> values_of(const std::string& obj, const std::string& mtl = "") {
  const SceneFolder folder;
  folder.write("m.mtl", mtl);
  Scene scene = read_scene(folder.write("model.obj", obj));
  for (const char* setting : {"film.width=64", "film.height=48", "sampler.samples=1"})
    override_value(scene, setting, scene.faults);
  const World world = compile(scene);
  const Image image = render(world, {}).image;
  const auto behind = static_cast<float>(world.appearance.environment.color.x);
  std::vector<float> values;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (image.at(x, y)[0] != behind) values.push_back(image.at(x, y)[0]);
  return values;
}

TEST(ModelAlone, FacesTurnedDifferentlyHaveDifferentValuesAndNoneIsDark) {
  const std::vector<float> values = values_of("o cube\n" + cube);
  ASSERT_GT(values.size(), 600u);
  EXPECT_GE(*std::min_element(values.begin(), values.end()), 0.1f);
  EXPECT_LE(*std::max_element(values.begin(), values.end()), 0.5f);
  std::set<int> steps;  // each face's values lie within one fiftieth of another
  for (const float value : values) steps.insert(static_cast<int>(value * 50));
  int apart = 1;
  for (auto at = steps.begin(); std::next(at) != steps.end(); ++at)
    apart += *std::next(at) - *at > 1 ? 1 : 0;
  EXPECT_EQ(apart, 3) << "three faces are seen";
}

TEST(ModelAlone, AWhiteModelDoesNotBurnOut) {
  const std::vector<float> values =
      values_of("mtllib m.mtl\nusemtl white\n" + cube, "newmtl white\nKd 1 1 1\n");
  ASSERT_GT(values.size(), 600u);
  EXPECT_LE(*std::max_element(values.begin(), values.end()), 1.0f);
  EXPECT_GE(*std::min_element(values.begin(), values.end()), 0.2f);
}

TEST(ModelAlone, AFloorIsSeen) {
  EXPECT_GT(values_of("o floor\nv -2 0 -2\nv 2 0 -2\nv 2 0 2\nv -2 0 2\nf 4 3 2 1\n").size(), 600u);
}

TEST(ModelAlone, QuadsThatAreNotFlatAndColoursOfVerticesAreTaken) {
  EXPECT_GT(values_of("v -1 -1 0\nv 1 -1 0.3\nv 1 1 0\nv -1 1 0.3\nf 1 2 3 4\n").size(), 600u);
  EXPECT_GT(values_of("v -1 -1 0 1 0 0\nv 1 -1 0 0 1 0\nv 1 1 0 0 0 1\nf 1 2 3\n").size(), 300u);
}

}  // namespace
}  // namespace portalens
