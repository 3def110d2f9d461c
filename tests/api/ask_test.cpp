// What a compiled world answers others who use the library: pictures, paths of photons, the field.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "io/image.h"
#include "portalens/portalens.h"
#include "support/scene_folder.h"

namespace portalens::api {
namespace {

World lens(int width = 48, int height = 32) {
  Scene scene = Scene::from_text(R"(
[camera]
position = [0, 1, 6]
look_at = [0, 1, 0]
[sampler]
samples = 1
[environment]
color = [0.2, 0.3, 0.5]
[[material]]
name = "glow"
emitted = [1, 2, 3]
[[sphere]]
name = "ball"
center = [1.2, 1, -3]
radius = 0.8
material = "glow"
[[mass]]
name = "hole"
center = [0, 1, 0]
mass = 150.0
)");
  scene.set("film", {{"width", width}, {"height", height}});
  return compile(scene);
}

TEST(ApiRender, TellsEachPixelOnceAndEndsAtAll) {
  const World world = lens(100, 70);
  RenderOptions options;
  options.threads = 3;
  std::size_t last = 0, tiles = 0;
  std::vector<float> seen(3 * 100 * 70, -1.0f);
  options.progress = [&](const Progress& progress) {
    EXPECT_GT(progress.done, last);
    EXPECT_EQ(progress.total, 7000u);
    EXPECT_EQ(progress.window, (Window{0, 0, 100, 70}));
    last = progress.done;
    tiles += static_cast<std::size_t>(progress.tile.width() * progress.tile.height());
    for (int y = progress.tile.y0; y < progress.tile.y1; ++y)
      for (int i = 3 * progress.tile.x0; i < 3 * progress.tile.x1; ++i)
        seen[static_cast<std::size_t>(300 * y + i)] =
            progress.rgb[static_cast<std::size_t>(300 * y + i)];
  };
  const Rendering rendering = render(world, options);
  EXPECT_TRUE(rendering.complete);
  EXPECT_EQ(last, 7000u);
  EXPECT_EQ(tiles, 7000u);
  EXPECT_EQ(seen, rendering.picture.rgb);
  EXPECT_EQ(rendering.photons, 7000u);
  EXPECT_GT(rendering.ended(Fate::absorbed), 0u);
  EXPECT_EQ(rendering.ended(Fate::hit) + rendering.ended(Fate::absorbed) +
                rendering.ended(Fate::escaped) + rendering.ended(Fate::trapped) +
                rendering.ended(Fate::lost),
            7000u);
}

TEST(ApiRender, StopsWhenItIsToldTo) {
  const World world = lens(200, 200);
  RenderOptions options;
  options.threads = 2;
  std::atomic<bool> stop{false};
  options.progress = [&](const Progress&) { stop = true; };
  options.cancelled = [&] { return stop.load(); };
  const Rendering rendering = render(world, options);
  EXPECT_FALSE(rendering.complete);
  EXPECT_LT(rendering.photons, 40000u);
  EXPECT_EQ(rendering.picture.rgb.size(), 120000u);
}

TEST(ApiRender, WhatACallbackThrowsComesOutUnchanged) {
  struct Own {};
  const World world = lens(200, 200);
  RenderOptions options;
  int calls = 0;
  options.progress = [&](const Progress&) {
    ++calls;
    throw Own{};
  };
  EXPECT_THROW(static_cast<void>(render(world, options)), Own);
  EXPECT_EQ(calls, 1);
}

TEST(ApiRender, ACropIsThatPartOfThePicture) {
  const World world = lens();
  RenderOptions options;
  options.crop = Window{10, 5, 30, 20};
  const Rendering all = render(world), part = render(world, options);
  EXPECT_EQ(part.window, *options.crop);
  EXPECT_EQ(part.picture.width, 20);
  for (int y = 0; y < 15; ++y)
    for (int x = 0; x < 20; ++x)
      for (int c = 0; c < 3; ++c)
        ASSERT_EQ(part.picture.at(x, y)[c], all.picture.at(x + 10, y + 5)[c]);
  for (const Window& wrong : {Window{0, 0, 49, 32}, Window{-1, 0, 5, 5}, Window{5, 5, 5, 9}}) {
    options.crop = wrong;
    EXPECT_THROW(static_cast<void>(render(world, options)), Error);
  }
  options = {};
  options.threads = -1;
  EXPECT_THROW(static_cast<void>(render(world, options)), Error);
}

TEST(ApiRender, LayersComeInTheirOwnOrderAndNameTheirObjects) {
  const World world = lens();
  RenderOptions options;
  options.layers = {Layer::object, Layer::depth, Layer::object};
  const Picture picture = render(world, options).picture;
  ASSERT_EQ(picture.layers.size(), 2u);
  EXPECT_EQ(picture.layers[0].name, "depth.Z");
  EXPECT_EQ(picture.layers[1].name, "object.X");
  const std::vector<std::string> names = layer_objects(world);
  bool ball_seen = false;
  for (const float number : picture.layers[1].values)
    ball_seen |= number > 0.0f && names.at(static_cast<std::size_t>(number) - 1) == "ball";
  EXPECT_TRUE(ball_seen);
}

TEST(ApiPicture, AnExrKeepsAllAndAPngRefusesLayers) {
  const SceneFolder folder;
  RenderOptions options;
  options.layers = {Layer::depth};
  Picture picture = render(lens(), options).picture;
  const std::filesystem::path file = folder.path() / "lens.exr";
  write_picture(file, picture, {{"Comment", "mine"}});
  Faults faults;
  const auto back = read_channels(file, {}, faults);
  ASSERT_TRUE(back && faults.empty());
  ASSERT_EQ(back->channels.size(), 4u);
  for (const auto& channel : back->channels) {
    if (channel.name == "depth.Z") {
      EXPECT_EQ(channel.values, picture.layers[0].values);
    }
    if (channel.name == "G") {
      EXPECT_EQ(channel.values[5], picture.at(5, 0)[1]);
    }
  }
  EXPECT_THROW(write_picture(folder.path() / "lens.png", picture), Error);
  EXPECT_THROW(write_picture(folder.path() / "lens.gif", picture), Error);
  picture.layers[0].values.pop_back();
  EXPECT_THROW(write_picture(file, picture), Error);
  picture.layers.clear();
  write_picture(folder.path() / "lens.png", picture);
  picture.rgb.pop_back();
  EXPECT_THROW(write_picture(file, picture), Error);
  EXPECT_EQ(folder.size(), 2u);
}

TEST(ApiPicture, AFolderThatIsNotThereIsAFaultOfTheWork) {
  try {
    write_picture("/nowhere/at/all.png", {1, 1, {0, 0, 0}, {}});
    FAIL() << "it was written";
  } catch (const Error& error) {
    EXPECT_EQ(error.cause(), Cause::work);
    EXPECT_EQ(error.faults().size(), 1u);
  }
}

TEST(ApiTrace, TellsWhereEachPhotonOfAFanGoes) {
  const World world = lens();
  const std::vector<Ray> rays = fan({{0, 1, 6}, {0, 0, -2}}, {0, 1, 0}, 60, 61);
  ASSERT_EQ(rays.size(), 61u);
  for (const Ray& ray : rays) {
    EXPECT_NEAR(std::hypot(ray.direction.x, ray.direction.z), 1.0, 1e-12);
    EXPECT_EQ(ray.direction.y, 0.0);
  }
  TraceOptions options;
  options.path = true;
  const std::vector<Trace> traces = trace(world, rays, options);
  ASSERT_EQ(traces.size(), 61u);
  EXPECT_EQ(traces[30].fate, Fate::absorbed);
  EXPECT_EQ(traces[30].object, "hole");
  EXPECT_EQ(traces[0].fate, Fate::escaped);
  EXPECT_EQ(traces[0].object, "");
  for (int i = 0; i < 30; ++i) {  // the hole is in the middle of the fan
    EXPECT_EQ(traces[i].path.front().front(), rays[i].origin);
    if (traces[i].fate == Fate::escaped && traces[60 - i].fate == Fate::escaped) {
      EXPECT_NEAR(traces[i].turning, traces[60 - i].turning, 1e-3);
    }
  }
  EXPECT_TRUE(trace(world, rays[30]).path.empty());
  EXPECT_STREQ(to_string(Fate::trapped), "trapped");
}

TEST(ApiTrace, GoesOnFromMirrorsIfItIsAskedTo) {
  const World world = lens();
  TraceOptions options;
  options.bounces = 3;
  const Trace found = trace(world, {{1.2, 1, 6}, {0, 0, -1}}, options);
  ASSERT_EQ(found.bounces.size(), 1u);
  EXPECT_EQ(found.bounces[0].object, "ball");
  EXPECT_GT(found.length, found.bounces[0].length);
  options.bounces = -1;
  EXPECT_THROW(static_cast<void>(trace(world, {{0, 0, 0}, {0, 0, 1}}, options)), Error);
}

TEST(ApiTrace, EveryRayThatIsNoneIsNamed) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Ray> rays = {
      {{0, 0, 0}, {0, 0, 0}}, {{0, 0, 9}, {0, 0, 1}}, {{nan, 0, 0}, {0, 0, 1}}};
  try {
    static_cast<void>(trace(lens(), rays));
    FAIL() << "they were traced";
  } catch (const Error& error) {
    ASSERT_EQ(error.faults().size(), 2u);
    EXPECT_NE(error.faults()[1].problem.find("ray 2"), std::string::npos);
  }
  const Ray good{{0, 0, 0}, {0, 0, 1}};
  EXPECT_THROW(static_cast<void>(fan(good, {0, 1, 0}, 10, 0)), Error);
  EXPECT_THROW(static_cast<void>(fan(good, {0, 1, 0}, 361, 3)), Error);
  EXPECT_THROW(static_cast<void>(fan(rays[0], {0, 1, 0}, 10, 3)), Error);
}

TEST(ApiTrace, TheCamerasRayThroughTheMiddleLooksForward) {
  const Ray ray = camera_ray(lens(), 24, 16);
  EXPECT_EQ(ray.origin, (Vec3{0, 1, 6}));
  EXPECT_NEAR(ray.direction.z, -1.0, 1e-15);
}

TEST(ApiField, IsTheSumOfWhatPullsDirectly) {
  const World world = lens();
  const std::vector<Vec3> places = {{3, 1, 0}, {0, 1, 1000}};
  const std::vector<Vec3> pulls = field(world, places);
  ASSERT_EQ(pulls.size(), 2u);
  EXPECT_DOUBLE_EQ(pulls[0].x, -150.0 / 9);
  EXPECT_EQ(pulls[1], Vec3{}) << "beyond its influence a mass does nothing";
  const Field here = field_parts(world, places[0]);
  ASSERT_EQ(here.parts.size(), 1u);
  EXPECT_EQ(here.parts[0].mass, "hole");
  EXPECT_DOUBLE_EQ(here.parts[0].distance, 3.0);
  EXPECT_EQ(here.parts[0].acceleration, here.acceleration);
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW(static_cast<void>(field_parts(world, {0, infinity, 0})), Error);
}

TEST(ApiField, NamesThePortalsThatPullComesThrough) {
  Scene scene = Scene::from_text(R"(
[[mass]]
name = "hole"
center = [2.5, 1, 3]
mass = 150.0
[[portal]]
name = "in"
pair = "out"
vertices = [[-3, 0, -1], [-2, 0, -1], [-2, 2, -1], [-3, 2, -1]]
[[portal]]
name = "out"
pair = "in"
vertices = [[2, 0, -1], [3, 0, -1], [3, 2, -1], [2, 2, -1]]
)");
  bool through = false;
  for (const FieldPart& part : field_parts(compile(scene), {-2.5, 1, 1}).parts)
    through |= part.portals == std::vector<std::string>{"in"};
  EXPECT_TRUE(through);
}

}  // namespace
}  // namespace portalens::api
