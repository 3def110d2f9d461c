/// \file
/// `portalens draw`: what is in the drawing, and that it is the same in every form.
#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "app/draw_scene.h"
#include "io/image.h"
#include "io/override.h"
#include "io/read_scene.h"
#include "support/run_program.h"
#include "world/compile.h"

namespace portalens {
namespace {

/// A hole, a pair of portals, a mirror-like floor, and one of each other shape; names that XML must
/// not take at their word.
const std::string scene_file = R"([physics]
min_force = 20.0
tolerance = 1e-3
[camera]
position = [0, 1, 9]
look_at = [0, 1, 0]
[film]
width = 64
height = 48
[[mass]]
name = "hole"
center = [-1, 1.5, 0]
mass = 200
[[portal]]
name = "blue <in> & \"out\""
pair = "orange"
vertices = [[1, 0, -3], [3, 0, -3], [3, 2, -3], [1, 2, -3]]
[[portal]]
name = "orange"
pair = "blue <in> & \"out\""
vertices = [[-6, 0, -2], [-6, 0, -4], [-6, 2, -4], [-6, 2, -2]]
[[quad]]
name = "floor"
vertices = [[-9, -1, 9], [9, -1, 9], [9, -1, -9], [-9, -1, -9]]
[[sphere]]
name = "Kugel é"
center = [4, 0, 0]
radius = 0.5
[[cube]]
center = [5, 0, 1]
size = 1
rotation = [10, 20, 30]
[[cone]]
base = [4, 0, 3]
height = 1
radius = 0.5
[[cylinder]]
base = [-4, 0, 3]
height = 1
radius = 0.5
[[ring]]
base = [-4, 0, 5]
height = 1
inner_radius = 0.3
outer_radius = 0.6
)";

class Draw : public testing::Test {
 protected:
  Draw() { folder_.write("scene.toml", scene_file); }

  [[nodiscard]] World world() const { return compile(read_scene(folder_.path() / "scene.toml")); }

  Outcome draw(std::vector<std::string> words) const {
    words.insert(words.begin(), {"draw", "scene.toml"});
    return run_portalens(folder_.path(), words);
  }

  SceneFolder folder_;
};

Photon photon_along(const Ray& ray) {
  Photon photon;
  photon.position = ray.origin;
  photon.direction = ray.direction;
  return photon;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++found;
  return found;
}

/// The data of the SVG paths of that class, one after another.
std::string path_data(const std::string& svg, const std::string& meaning) {
  std::string data;
  const std::regex path("<path class=\"" + meaning + "\"[^>]* d=\"([^\"]*)\"");
  for (std::sregex_iterator it(svg.begin(), svg.end(), path), end; it != end; ++it)
    data += (*it)[1];
  return data;
}

const std::vector<std::string> into_the_portal = {"--view", "top", "--ray", "2",  "1",    "2",
                                                  "0",      "0",   "-1",    "-o", "a.svg"};

TEST_F(Draw, SvgIsWellFormedWhateverTheNames) {
  for (const std::string view : {"camera", "top", "front", "side"}) {
    const std::string name = view + ".svg";
    const Outcome outcome =
        draw({"--view", view,      "--fan", "0", "1",      "8",  "0",  "0",         "-1", "60",
              "9",      "--pixel", "3",     "4", "--grid", "3",  "2",  "--bounces", "2",  "--ray",
              "4",      "0.2",     "2",     "0", "0",      "-1", "-o", name});
    ASSERT_EQ(outcome.code, 0) << outcome.errors;
    const Outcome parsed =
        run_shell(folder_.path(),
                  "python3 -c 'import sys, xml.dom.minidom as m; m.parse(sys.argv[1])' " + name);
    EXPECT_EQ(parsed.code, 0) << parsed.errors;
    EXPECT_NE(folder_.read(name).find("Kugel é"), std::string::npos) << "a met surface is named";
  }
}

TEST_F(Draw, EachStepIsOneSegmentInTurnGreenAndGrey) {
  const std::string pull_by = "physics.integrator=euler";
  const Outcome outcome = draw({"--set", pull_by, "--view", "front", "--extent", "-40", "-40", "40",
                                "40", "--ray", "-8", "4", "0", "1", "0", "0", "-o", "a.svg"});
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  Scene scene = read_scene(folder_.path() / "scene.toml");
  Faults faults;
  override_value(scene, pull_by, faults);
  const Trace trace = trace_ray(compile(scene), photon_along({{-8, 4, 0}, {1, 0, 0}}), 0);
  ASSERT_GT(trace.end.steps, 50u);
  std::size_t steps = 0;
  for (const auto& stretch : trace.path_trace.stretches)
    for (std::size_t i = 1; i < stretch.size(); ++i)
      if (!(stretch[i] == stretch[i - 1])) ++steps;
  const std::string svg = folder_.read("a.svg");
  EXPECT_EQ(count(path_data(svg, "path green"), "M"), (steps + 1) / 2);
  EXPECT_EQ(count(path_data(svg, "path grey"), "M"), steps / 2);
}

TEST_F(Draw, APathEndsWhereTraceSays) {
  const World scene = world();
  const StandpointChoice top{Standpoint::top, {}, {}, {}, {{-10, -10, 10, 10}}};
  const std::vector<NamedRay> rays = {{"one", {{2, 1, 2}, normalize(Vec3d{0, -0.15, -1})}},
                                      {"two", {{-3, 1, 5}, normalize(Vec3d{1, -0.3, -2})}}};
  for (const NamedRay& ray : rays) {
    const auto paths = follow(scene, {ray}, 1, 1);
    const Trace trace = trace_ray(scene, photon_along(ray.ray), 1);
    EXPECT_EQ(paths[0].trace.end.position, trace.end.position);
    const Drawing drawing = draw_scene(scene, paths, top, {{400, 400}, 1, false});
    const View view(drawing_camera(scene, top, box_of_interest(scene, paths), 1.0), 400, 400, 1.0);
    const auto end = view.project(trace.end.position);
    ASSERT_TRUE(end);
    bool ends_there = false;
    for (const Mark& mark : drawing.marks)
      if (const auto* lines = std::get_if<Lines>(&mark);
          lines && lines->meaning.rfind("path ", 0) == 0)
        ends_there = ends_there || lines->pieces.back().back() == *end;
    EXPECT_TRUE(ends_there);
  }
}

TEST_F(Draw, APlanShowsPlacesToScale) {
  const World scene = world();
  const std::array<double, 4> extent = {-10, -4, 10, 6};
  struct Case {
    Standpoint from;
    Vec3d place;
    Point shown;
  };
  // 20 x 10 lengths on 400 x 200 pixels.
  for (const Case& one :
       {Case{Standpoint::top, {-10, 3, -4}, {0, 0}}, Case{Standpoint::top, {5, 3, 1}, {300, 100}},
        Case{Standpoint::front, {-10, -4, 7}, {0, 200}},
        Case{Standpoint::front, {5, 1, 7}, {300, 100}},
        Case{Standpoint::side, {3, 6, -10}, {400, 0}},
        Case{Standpoint::side, {3, 1, 5}, {100, 100}}}) {
    const StandpointChoice choice{one.from, {}, {}, {}, extent};
    const View view(drawing_camera(scene, choice, box_of_interest(scene, {}), 2.0), 400, 200, 1.0);
    const auto point = view.project(one.place);
    ASSERT_TRUE(point);
    EXPECT_NEAR(point->x, one.shown.x, 1e-9);
    EXPECT_NEAR(point->y, one.shown.y, 1e-9);
  }
}

TEST_F(Draw, TheCamerasViewIsWhatTheCameraTakes) {
  const World scene = world();
  const View view(scene.camera, 64, 48, 1e-3);
  for (const Point film : {Point{0, 0}, Point{64, 48}, Point{10.5, 40.25}}) {
    const Ray ray = scene.camera.ray(film.x, film.y, 64, 48);
    const auto point = view.project_line(std::vector<Vec3d>{ray.at(2.0), ray.at(7.0)});
    ASSERT_EQ(point.size(), 1u);
    EXPECT_NEAR(point[0].back().x, film.x, 1e-9);
    EXPECT_NEAR(point[0].back().y, film.y, 1e-9);
  }
  EXPECT_FALSE(view.project({0, 1, 10})) << "it lies behind";
  const auto clipped = view.project_line(std::vector<Vec3d>{{0, 0, 0}, {0, 0, 20}});
  for (const PointChain& piece : clipped)
    for (const Point& point : piece) EXPECT_TRUE(std::fabs(point.y) <= 2 * 48.0);
}

TEST_F(Draw, CrossingsAreMarkedInPairsByOneLetter) {
  ASSERT_EQ(draw(into_the_portal).code, 0);
  const std::string svg = folder_.read("a.svg");
  EXPECT_EQ(count(svg, "class=\"crossing\""), 2u);
  EXPECT_EQ(count(svg, "class=\"crossing letter\""), 2u);
  const std::regex letter("class=\"crossing letter\"[^>]*>A<");
  EXPECT_EQ(std::distance(std::sregex_iterator(svg.begin(), svg.end(), letter), {}), 2);
  EXPECT_NE(svg.find("A into blue &lt;in&gt;"), std::string::npos) << "and told in words";
}

TEST_F(Draw, CrossingsGoOnAfterZ) {
  EXPECT_EQ(crossing_letter(0), "A");
  EXPECT_EQ(crossing_letter(25), "Z");
  EXPECT_EQ(crossing_letter(26), "AA");
  EXPECT_EQ(crossing_letter(26 + 26 * 26), "AAA");
}

TEST_F(Draw, TheSceneItselfIsDrawn) {
  ASSERT_EQ(draw({"--view", "front", "-o", "a.svg"}).code, 0);
  const std::string svg = folder_.read("a.svg");
  EXPECT_EQ(count(svg, "class=\"horizon\""), 1u);
  EXPECT_EQ(count(svg, "class=\"influence\""), 1u);
  EXPECT_EQ(count(svg, "class=\"portal name\""), 2u);
  EXPECT_GE(count(svg, "class=\"surface\""), 6u);
  EXPECT_NE(svg.find(">scale") + svg.find("class=\"scale\""), std::string::npos);
  EXPECT_EQ(count(svg, "class=\"path"), 0u);
}

TEST_F(Draw, AHorizonIsDrawnAsLargeAsItIs) {
  const World scene = world();
  const StandpointChoice front{Standpoint::front, {}, {}, {}, {{-5, -5, 5, 5}}};
  const Drawing drawing = draw_scene(scene, {}, front, {{500, 500}, 1, false});
  const double radius = 2.0 * 200.0 / (45.0 * 45.0) * 50.0;  // pixels
  for (const Mark& mark : drawing.marks) {
    const auto* area = std::get_if<Area>(&mark);
    if (!area || area->meaning != "horizon") continue;
    for (const Point& corner : area->corners)
      EXPECT_NEAR(std::hypot(corner.x - 200.0, corner.y - 175.0), radius, 1e-6);
  }
}

TEST_F(Draw, PngIsNotEmptyAndTheSameBitsTwiceWhateverTheThreads) {
  const std::vector<std::string> rays = {"--view", "top", "--fan", "0",  "1", "8",
                                         "0",      "0",   "-1",    "60", "9", "-q"};
  const auto drawn = [&](const std::string& file, const std::string& threads) {
    std::vector<std::string> words = rays;
    words.insert(words.end(), {"-o", file, "-t", threads});
    const Outcome outcome = draw(words);
    EXPECT_EQ(outcome.code, 0) << outcome.errors;
    EXPECT_EQ(outcome.output, "");
    return folder_.read(file);
  };
  const std::string png = drawn("a.png", "1");
  EXPECT_EQ(drawn("b.png", "2"), png);
  EXPECT_EQ(drawn("a.svg", "1"), drawn("b.svg", "2"));
  Faults faults;
  const auto image = read_image(folder_.path() / "a.png", Location{}, faults);
  ASSERT_TRUE(image);
  EXPECT_EQ(image->width, 960);
  std::size_t green = 0;
  for (std::size_t i = 0; i + 2 < image->pixels.size(); i += 3)
    if (image->pixels[i + 1] > 3 * image->pixels[i]) ++green;
  EXPECT_GT(green, 500u);
}

TEST_F(Draw, FaultsOfTheCommandLineExitWith2AndSayWhatWouldBeRight) {
  const std::vector<std::vector<std::string>> wrong = {
      {"-o", "a.gif"},
      {"-o", "a"},
      {"--view", "below"},
      {"--pixel", "1"},
      {"--pixel", "1", "2", "--pixel", "1"},
      {"--ray", "0", "0", "0"},
      {"--pixel", "64", "0"},
      {"--pixel", "-1", "0"},
      {"--ray", "0", "0", "0", "0", "0", "0"},
      {"--ray", "0", "0", "0", "0", "nan", "1"},
      {"--fan", "0", "0", "0", "0", "0", "1", "30"},
      {"--fan", "0", "0", "0", "0", "0", "1", "30", "0"},
      {"--fan", "0", "0", "0", "0", "0", "1", "30", "2.5"},
      {"--fan", "0", "0", "0", "0", "0", "1", "nan", "2"},
      {"--grid", "0", "3"},
      {"--grid", "1000", "1000"},
      {"--rays", "none.txt"},
      {"--bounces", "-1"},
      {"--every", "0"},
      {"--width", "0"},
      {"--height", "100000"},
      {"--fov", "10"},
      {"--eye", "0", "0", "inf"},
      {"--eye", "1", "1", "1", "--look-at", "1", "1", "1"},
      {"--eye", "1", "1", "1", "--view", "top"},
      {"--extent", "0", "0", "1", "1"},
      {"--view", "top", "--extent", "1", "0", "0", "1"},
      {"--unknown"},
  };
  for (const auto& words : wrong) {
    const Outcome outcome = draw(words);
    EXPECT_EQ(outcome.code, 2) << quoted(words) << outcome.output;
    EXPECT_NE(outcome.errors, "") << quoted(words);
  }
  EXPECT_EQ(folder_.size(), 1u) << "nothing is written";
  EXPECT_EQ(draw({"-o", "nowhere/a.png"}).code, 1);
}

TEST_F(Draw, AnOptionForAPhotonMayBeRepeated) {
  const Outcome outcome =
      draw({"--pixel", "1", "1",     "--pixel", "2", "2", "--ray", "0",    "0", "9",  "0",
            "0",       "1", "--ray", "0",       "0", "9", "1",     "-0.5", "0", "-o", "a.svg"});
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  EXPECT_NE(outcome.output.find("4 photons"), std::string::npos) << outcome.output;
}

}  // namespace
}  // namespace portalens
