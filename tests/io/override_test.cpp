#include "io/override.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "io/read_scene.h"
#include "io/scene_values.h"

namespace portalens::test {
namespace {

Scene scene_from(const char* name, const std::string& text) { return read_scene_text(text, name); }

TEST(Override, SetsAValueAsTheFileWould) {
  Scene scene = scene_from("a.toml", "[film]\nwidth = 10\n");
  Faults faults;
  override_value(scene, "film.width=20", faults);
  override_value(scene, "physics.tolerance=1e-5", faults);
  override_value(scene, "physics.portal_gravity=shortest-path", faults);
  override_value(scene, "physics.integrator=\"rk4\"", faults);
  override_value(scene, "environment.color=[0.5, 0.25, 1.0]", faults);
  override_value(scene, "environment.image=a.b/sky.exr", faults);
  EXPECT_NO_THROW(faults.raise());
  EXPECT_EQ(std::get<std::int64_t>(scene.film.find("width")->data), 20);
  EXPECT_EQ(scene.film.entries.size(), 1U);
  EXPECT_EQ(number_of(scene.physics, "tolerance"), 1e-5);
  EXPECT_EQ(text_of(scene.physics, "portal_gravity"), "shortest-path");
  EXPECT_EQ(text_of(scene.physics, "integrator"), "rk4");
  EXPECT_EQ(numbers_of(*scene.environment.find("color")), (Numbers{0.5, 0.25, 1.0}));
  EXPECT_EQ(text_of(scene.environment, "image"), "a.b/sky.exr");
  EXPECT_EQ(scene.film.find("width")->where.file, nullptr);
}

TEST(Override, RefusesWhatSetsNothing) {
  Scene scene = scene_from("a.toml", "[film]\nwidth = 10\n");
  const std::vector<std::string> bad = {"",
                                        "width=3",
                                        "film.width",
                                        "film.=3",
                                        ".width=3",
                                        "films.w=3",
                                        "sphere.radius=3",
                                        "film.width=",
                                        "film.width=[1",
                                        "film.width=1 2",
                                        "film.width=1\nheight = 2",
                                        "film.width=1979-05-27",
                                        "film.width=a b"};
  for (const std::string& assignment : bad) {
    Faults faults;
    override_value(scene, assignment, faults);
    EXPECT_EQ(faults.size(), 1U) << assignment;
  }
  EXPECT_EQ(std::get<std::int64_t>(scene.film.find("width")->data), 10);
}

TEST(Override, SetsValuesOfWhatHasAName) {
  Scene scene = scene_from("a.toml",
                           "[[material]]\nname = \"floor\"\n[[sphere]]\nradius = 1\n"
                           "[[sphere]]\nname = \"a.b\"\n[[sphere]]\nradius = 1\n"
                           "[[portal]]\nname = \"blue\"\n[[light]]\nintensity = 3\n");
  Faults faults;
  override_value(scene, "material.floor.diffuse=[1.0, 0.0, 0.0]", faults);
  override_value(scene, "sphere.sphere0.radius=2.5", faults);
  override_value(scene, "sphere.1.radius=3.5", faults);
  override_value(scene, "sphere.sphere2.radius=4.5", faults);
  override_value(scene, "portal.blue.tint=[0.5, 1.0, 1.0]", faults);
  override_value(scene, "light.light0.intensity=5.5", faults);
  EXPECT_NO_THROW(faults.raise());
  override_value(scene, "camera.look_at=[.5,-.25, +.125]", faults);  // as bc prints them
  override_value(scene, "camera.fov=.5", faults);
  EXPECT_NO_THROW(faults.raise());
  EXPECT_EQ(numbers_of(*scene.camera.find("look_at")), (Numbers{0.5, -0.25, 0.125}));
  EXPECT_EQ(number_of(scene.camera, "fov"), 0.5);
  EXPECT_EQ(numbers_of(*scene.materials[0].find("diffuse")), (Numbers{1, 0, 0}));
  EXPECT_EQ(number_of(scene.objects[0], "radius"), 2.5);
  EXPECT_EQ(number_of(scene.objects[1], "radius"), 3.5);
  EXPECT_EQ(number_of(scene.objects[2], "radius"), 4.5);
  EXPECT_EQ(numbers_of(*scene.objects[3].find("tint")), (Numbers{0.5, 1, 1}));
  EXPECT_EQ(number_of(scene.lights[0], "intensity"), 5.5);
}

TEST(Override, SaysWhichNamesThereAre) {
  for (const auto& [assignment, message] :
       {std::pair{"sphere.bal.radius=2", "no [[sphere]] is named 'bal'; did you mean ball?"},
        {"cube.ball.size=2", "the scene has no [[cube]]; "},
        {"sphere.radius=2",
         "'sphere.radius' does not say which one; write its name, as in "
         "sphere.ball.radius=..."},
        {"sphere.ball=2",
         "'sphere.ball' does not say which value; write its key, as in "
         "sphere.ball.KEY=..."},
        {"camera.position.x=2",
         "a value of [camera] has no parts to be set alone; set all of it, "
         "as in camera.position=..."},
        {"sphere.ball.radius=05", "'05' is no number of TOML"},
        {"sphere.ball.radius=5.", "'5.' is no number of TOML"},
        {"sphere.ball.radius=1e400", "'1e400' is no number of TOML"},
        {"sphere..radius=2", "sets nothing"}}) {
    Scene scene = scene_from("a.toml", "[[sphere]]\nname = \"ball\"\n");
    Faults faults;
    override_value(scene, assignment, faults);
    try {
      faults.raise();
      ADD_FAILURE() << assignment;
    } catch (const SceneError& error) {
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace portalens::test
