#include <gtest/gtest.h>

#include "support/scene_text.h"

namespace portalens {
namespace {

using test::faults_of;
using test::Folder;

struct Case {
  std::string toml;
  int line;
  std::string problem, remedy;  ///< words that must occur
};

void expect_only(const Case& c, const std::vector<Fault>& faults) {
  std::string all;
  for (const Fault& fault : faults) all += to_string(fault) + "\n";
  ASSERT_EQ(faults.size(), 1u) << c.toml << "\n" << all;
  EXPECT_EQ(faults[0].where.line, c.line) << c.toml << "\n" << all;
  EXPECT_NE(faults[0].problem.find(c.problem), std::string::npos) << all;
  EXPECT_NE(faults[0].remedy.find(c.remedy), std::string::npos) << all;
  EXPECT_FALSE(faults[0].remedy.empty()) << all;
}

void expect_each(const std::vector<Case>& cases) {
  for (const Case& c : cases) expect_only(c, faults_of(c.toml));
}

const std::string sphere = "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\n";

std::string portal(const std::string& name, const std::string& pair, const std::string& vertices) {
  return "[[portal]]\nname = \"" + name + "\"\npair = \"" + pair + "\"\nvertices = " + vertices +
         "\n";
}

const std::string square = "[[0,0,0], [2,0,0], [2,2,0], [0,2,0]]";
const std::string moved = "[[0,0,9], [2,0,9], [2,2,9], [0,2,9]]";

TEST(Faults, OfCameras) {
  const std::string at = "[camera]\nposition = [0,0,9]\nlook_at = [0,0,0]\n";
  expect_each({
      {"[camera]\nlook_at = [0,0,0]\n", 1, "no 'position'", "list of three"},
      {"[camera]\nposition = [1,2,3]\nlook_at = [1,2,3]\n", 3, "looks at its own position", "move"},
      {"[camera]\nposition = [0,9,0]\nlook_at = [0,0,0]\n", 1, "parallel", "[0, 0, -1]"},
      {"[camera]\nposition = [1e300,0,9]\nlook_at = [0,0,0]\n", 2, "1e+300", "1e+12"},
      {at + "up = [0,0,0]\n", 4, "no direction", "[0, 1, 0]"},
      {at + "fov = 180\n", 4, "'fov'", "179.9"},
      {at + "size = 2\n", 4, "unknown key 'size'", ""},
      {"[camera]\npositoin = [0,0,9]\nlook_at = [0,0,0]\n", 2, "unknown key 'positoin'",
       "position"},
      {at + "type = \"orthographic\"\n", 1, "no 'size'", "number greater than 0"},
      {at + "type = \"fisheye\"\n", 4, "fisheye", "perspective, orthographic"},
  });
}

TEST(Faults, OfTablesThatThereAreNone) {
  expect_each({
      {"[[torus]]\nradius = 1\n[[torus]]\n", 1, "unknown table 'torus'", "known are camera"},
      {"knots = [1, { radius = 3 }]\n", 1, "unknown key 'knots'", "sphere"},
      {"sphere = 3\n", 1, "sphere is not a list of tables", "write [[sphere]]"},
      {"[light]\nintensity = [1, 1, 1]\n", 1, "light is not a list of tables", "[[light]]"},
      {"cube = [4]\n", 1, "cube contains what is not a table", "write [[cube]]"},
  });
}

TEST(Faults, OfSections) {
  expect_each({
      {"[film]\nwidth = 0\n", 2, "'width' is 0", "from 1"},
      {"[film]\nwidth = 60000\nheight = 60000\n", 2, "268 million", "smaller"},
      {"[sampler]\nsamples = 0\n", 2, "'samples' is 0", "from 1"},
      {"[sampler]\nseed = -1\n", 2, "'seed' is -1", "from 0"},
      {"[physics]\nc = 0\n", 2, "'c' is 0", ""},
      {"[physics]\nG = -1\n", 2, "'G' is -1", "at least 0"},
      {"[physics]\nintegrator = \"rk45\"\n", 2, "rk45", "adaptive, rk4, euler"},
      {"[physics]\nlaw = \"swarzschild\"\n", 2, "swarzschild", "schwarzschild"},
      {"[physics]\nportal_gravity = \"closestpoint\"\n", 2, "closestpoint", "closest-point"},
      {"[physics]\nmax_step = 3\n", 2, "unknown key 'max_step'", "max_steps"},
      {"[shading]\nmax_bounces = 2.5\n", 2, "'max_bounces'", "whole number"},
      {"[shading]\nmax_depth = 2\n", 2, "unknown key 'max_depth'", "max_bounces"},
      {"[environment]\ncolor = [0, -1, 0]\n", 2, "'color'", "at least 0"},
      {"[environment]\nstrength = 3\n", 2, "unknown key 'strength'", "intensity"},
      {"[environment]\nrotation = 3\n", 2, "can't be rotated", "image"},
      {"[environment]\nimage = \"no.exr\"\n", 2, "no.exr", ""},
  });
}

TEST(Faults, OfMaterials) {
  const std::string light = "[[light]]\nname = \"a\"\nposition = [0,0,0]\nintensity = [1,1,1]\n";
  expect_each({
      {"[[material]]\ndiffuse = 3\n", 2, "neither a colour nor a texture", "checker"},
      {"[[material]]\ndiffuse = [1, 2]\n", 2, "'diffuse'", "three numbers"},
      {"[[material]]\ndiffuse = \"no.png\"\n", 2, "no.png", ""},
      {"[[material]]\ndiffuse = \"#ff8000\"\n", 2, "'#ff8000' is in sRGB", "[1, 0.216, 0]"},
      {"[[material]]\ndiffuse = { checker = [[0,0,0]] }\n", 2, "'checker'", "2 points"},
      {"[[material]]\ndiffuse = { checker = [[0,0,0],[1,1,1]], scale = 2 }\n", 2,
       "unknown key 'scale'", "size"},
      {"[[material]]\ndiffuse = { checker = [[0,0,0],[1,-1,1]] }\n", 2, "negative", "at least 0"},
      {"[[material]]\nroughness = 2\n", 2, "'roughness' is 2", "from 0 to 1"},
      {"[[material]]\nemited = [1,1,1]\n", 2, "unknown key 'emited'", "emitted"},
      {"[[material]]\nname = \"red\"\n" + sphere + "material = \"rad\"\n", 6,
       "unknown material 'rad'", "red"},
      {sphere + "material = \"black\"\n", 4, "unknown material 'black'", "[[material]]"},
      {"[[material]]\nname = \"a\"\n[[material]]\nname = \"a\"\n", 4, "'a' is taken by line 2",
       "name"},
      {light + sphere + "name = \"a\"\n", 8, "'a' is taken by line 2", "name"},
      {"[[light]]\nposition = [0,0,0]\n", 1, "no 'intensity'",
       "a number of at least 0, or a list of three"},
  });
}

TEST(Faults, OfMasses) {
  expect_each({
      {sphere + "mass = -1\n", 4, "'mass' is -1", "at least 0"},
      {sphere + "core_radius = 1\n", 4, "no meaning without a mass", "mass"},
      {sphere + "horizon = true\n", 4, "no meaning without a mass", "mass"},
      {sphere + "mass = 1\ncentre_of_mass = [0,0,0]\n", 5, "centre_of_mass", "center_of_mass"},
      {sphere + "mass = 1e300\n", 4, "wider than 1e12", "smaller"},
      {"[[mass]]\nmass = 1\n", 1, "no 'center'", "three numbers"},
      {"[[mass]]\ncenter = [0,0,0]\n", 1, "no 'mass'", "number"},
      {"[[mass]]\ncenter = [0,0,0]\nmass = 1\nmaterial = \"a\"\n", 4, "unknown key 'material'", ""},
  });
}

TEST(Faults, OfPortals) {
  const std::string b = portal("b", "a", moved);
  const auto a = [&](const std::string& vertices) { return portal("a", "b", vertices) + b; };
  expect_each({
      {a("[[0,0,0], [2,0,0]]"), 4, "list of 2", "3 to 64"},
      {a("[[0,0,0], [2,0,0], [2,2,0.1], [0,2,0]]"), 4, "not in one plane", "one plane"},
      {a("[[0,0,0], [2,0,0], [0,2,0], [2.5,2.5,0]]"), 4, "vertex 1 to 2 meets that from 3 to 0",
       "counter-clockwise"},
      {a("[[0,0,0], [2,0,0], [2,0,0], [0,2,0]]"), 4, "vertices 1 and 2 coincide", "once"},
      {a("[[0,0,0], [1,0,0], [2,0,0]]"), 4, "on one line", "area"},
      {a("[[0,0,0], [2,2,0], [2,0,0], [0,2,0]]"), 4, "its edges cross", "in order around"},
      {a("[[0,0,0], [2,0,0], [2,3,0], [0,3,0]]"), 8, "not congruent", "same size"},
      {a("[[0,0,0], [2,0,0], [0,2,0]]"), 8, "different numbers of vertices", ""},
      {portal("a", "a", square), 3, "its own pair", "another"},
      {portal("a", "c", square), 3, "no portal has the name 'c'", ""},
      {portal("a", "b", square) + portal("b", "c", moved) + portal("c", "b", moved), 3,
       "'b' names 'c'", "name each other"},
      {portal("a", "b", square) + "bak = \"open\"\n" + b, 5, "unknown key 'bak'", "back"},
      {portal("a", "b", square) + "back = \"wood\"\n" + b, 5, "unknown material 'wood'", ""},
      {portal("a", "b", square) + "back = \"portal\"\n" + b, 5, "its pair 'b' has not", "both"},
      {portal("a", "b", square) + b + "back = \"portal\"\n", 9, "its pair 'a' has not", "neither"},
      {sphere + portal("a", "sphere0", square), 6, "no portal has the name 'sphere0'", ""},
  });
}

TEST(Faults, OfAPortalListedClockwiseSayInWhichOrdersItFits) {
  // Two upright doors, 1 x 2, both facing +z; b is listed as its back is seen.
  const std::string a = "[[0,0,0], [1,0,0], [1,2,0], [0,2,0]]";
  const auto faults =
      faults_of(portal("a", "b", a) + portal("b", "a", "[[5,0,0], [5,2,0], [6,2,0], [6,0,0]]"));
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].remedy,
            "begin the list of 'b' with its vertex 3 (counted from 0); or, if it is to face the "
            "other way, list the corners of 'b' in the order 0, 3, 2, 1");
  EXPECT_TRUE(
      faults_of(portal("a", "b", a) + portal("b", "a", "[[5,0,0], [6,0,0], [6,2,0], [5,2,0]]"))
          .empty());
}

/// A portal about a center, with these keys besides.
std::string about(const std::string& name, const std::string& pair, const std::string& keys) {
  return "[[portal]]\nname = \"" + name + "\"\npair = \"" + pair +
         "\"\ncenter = [0, 0, 0]\nfacing = [0, 0, 1]\n" + keys + "\n";
}

TEST(Faults, OfPortalsAboutACenter) {
  const std::string b = about("b", "a", "radius = 1.2");
  const auto a = [&](const std::string& keys) { return about("a", "b", keys) + b; };
  expect_each({
      {a("radius = 0"), 6, "'radius' is an integer", "a number, or [across, along]"},
      {a("radius = [1, 2, 3]"), 6, "'radius' is", "[across, along]"},
      {a("size = 2"), 6, "'size' is", "[width, height]"},
      {a("radius = [1, 1e-7]"), 6, "more than a million times", "more alike"},
      {a("radius = 1.2\nup = [0, 0, 2]"), 7, "along 'facing'", "aside"},
      {a("radius = 1.2\nsize = [1, 2]"), 7, "a size and a radius", "rectangle"},
      {a(""), 4, "no shape about it", "radius"},
      {a("radius = 1.3"), 12, "they differ by 0.0385 of the longer diameter", "the same radii"},
      {a("size = [2, 2]"), 12, "a pair of convex polygon and ellipse", "same kind"},
      {portal("a", "b", square) + "radius = 1.2\n" + b, 5, "vertices, and a center", "alone"},
  });
}

TEST(Faults, NoneOfPortalsAboutACenter) {
  const std::string two_sided = "\nback = \"portal\"";
  for (const char* keys : {"radius = 1", "radius = [1.2, 0.8]", "size = [2, 3]\nup = [1, 1, 0]"})
    EXPECT_TRUE(
        faults_of(about("a", "b", keys + two_sided) + about("b", "a", keys + two_sided)).empty())
        << keys;
}

TEST(Faults, BothPolygonsOfAPairThatDoesNotMatchAreNamed) {
  // The same rectangle, its list begun at another corner.
  const auto faults = faults_of(portal("a", "b", "[[0,0,0], [2,0,0], [2,3,0], [0,3,0]]") +
                                portal("b", "a", "[[2,0,9], [2,3,9], [0,3,9], [0,0,9]]"));
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_NE(faults[0].problem.find("'a' ([0, 0, 0] [2, 0, 0] [2, 3, 0] [0, 3, 0])"),
            std::string::npos);
  EXPECT_NE(faults[0].problem.find("'b' ([2, 0, 9]"), std::string::npos);
  EXPECT_NE(faults[0].remedy.find("begin the list of 'b' with its vertex"), std::string::npos);
}

TEST(Faults, OfPortalGravityWithoutAReach) {
  const std::string pair = portal("a", "b", square) + portal("b", "a", moved);
  const auto physics = [](const std::string& mode) {
    return "[physics]\nmin_force = 0\nportal_gravity = \"" + mode + "\"\n";
  };
  EXPECT_TRUE(faults_of(physics("none") + pair).empty());
  EXPECT_TRUE(faults_of(physics("closest-point") + sphere).empty());
  EXPECT_TRUE(faults_of(physics("shortest-path") + pair).empty());
  expect_each({{physics("closest-point") + pair, 2, "never lets a photon go", "above 0"},
               // The default, if none is named.
               {"[physics]\nmin_force = 0\n" + pair, 2, "'closest-point'", "shortest-path"}});
}

TEST(Faults, OfLawsThatNeedHorizons) {
  const auto physics = [](const std::string& law) {
    return "[physics]\nc = 10\nlaw = \"" + law + "\"\n";
  };
  const std::string bare = "[[mass]]\ncenter = [0,0,0]\nmass = 300\nhorizon = false\n";
  for (const char* law : {"schwarzschild", "extreme"})
    expect_each({{physics(law) + bare, 7, "neither a horizon nor a core", "core_radius"}});
  for (const char* law : {"newton", "einstein"})
    EXPECT_TRUE(faults_of(physics(law) + bare).empty());
  // m = 3: both together are deeper than light can be.
  const auto cored = [](const char* core) {
    return std::string("[[mass]]\ncenter = [9,0,0]\nmass = 300\ncore_radius = ") + core + "\n";
  };
  expect_each(
      {{physics("schwarzschild") + cored("3") + cored("3"), 3, "come to 2", "larger cores"}});
  EXPECT_TRUE(faults_of(physics("schwarzschild") + cored("3") + cored("3.1")).empty());
  EXPECT_TRUE(faults_of(physics("extreme") + cored("3") + cored("3")).empty());
}

TEST(Faults, OfMeshes) {
  const Folder folder;
  folder.write("empty.obj", "v 0 0 0\n");
  folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  for (const Case& c : std::vector<Case>{
           {"[[mesh]]\nfile = \"no.obj\"\n", 2, "no.obj", ""},
           {"[[mesh]]\nfile = \"../no.obj\"\n", 2, "no.obj", ""},
           {"[[mesh]]\nscale = 2\n", 1, "no 'file'", "string"},
       })
    expect_only(c, faults_of(folder, c.toml));
  EXPECT_FALSE(faults_of(folder, "[[mesh]]\nfile = \"empty.obj\"\n").empty());
  EXPECT_FALSE(faults_of(folder, "[[mesh]]\nfile = \"flat.obj\"\n").empty());
}

TEST(Faults, AreAllToldByLine) {
  const auto faults = faults_of(R"([camera]
position = [0, 0, 0]
look_at = [0, 0, 0]
[film]
width = -3
[[material]]
roughness = 7
[[sphere]]
center = [0, 0]
radius = -1
colour = 1
[[portal]]
pair = "x"
vertices = [[0,0,0], [2,0,0], [2,0,0], [0,2,0]]
)");
  std::vector<int> lines;
  for (const Fault& fault : faults) lines.push_back(fault.where.line);
  EXPECT_EQ(lines, (std::vector<int>{3, 5, 7, 9, 10, 11, 13, 14}));
}

}  // namespace
}  // namespace portalens
