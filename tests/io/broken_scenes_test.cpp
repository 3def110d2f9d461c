// Broken scene files: each fault is told with its line and a phrase that names it.
#include <gtest/gtest.h>
#include <stdio.h>
#include <sys/wait.h>

#include <string>
#include <utility>

#include "io/broken_files.h"

namespace portalens::test {
namespace {

constexpr Broken toml_form[] = {
    {"no value", "[film]\nwidth =\n", 2, "not TOML"},
    {"no closing bracket", "[film\nwidth = 1\n", 1, "not TOML"},
    {"open string", "[camera]\ntype = \"perspective\n", 2, "not TOML"},
    {"a key twice", "[film]\nwidth = 1\nwidth = 2\n", 3, "width"},
    {"a table twice", "[film]\nwidth = 1\n[film]\nheight = 2\n", 3, "film"},
    {"bare word", "[physics]\nintegrator = euler\n", 2, "not TOML"},
    {"table in braces over lines", "film = {\n  width = 1,\n}\n", 1, "stands on one line"},
    {"comma before the brace", "film = { width = 1, }\n", 1, "without a comma"},
    {"two keys on a line", "[film]\nwidth = 1 height = 2\n", 2, "not TOML"},
    {"open list", "[camera]\nposition = [1, 2\n", 2, "not TOML"},
    {"lost comma", "[camera]\nposition = [1 2 3]\n", 2, "not TOML"},
    {"control character", "[film]\nwidth = 1 # \x01\n", 2, "not TOML"},
    {"not UTF-8", "[film]\n# \xff\xfe\n", 2, "not TOML"},
    {"key before any table", "width = 3\n", 1, "unknown key 'width'"},
    {"unknown table", "[film]\n[cameras]\nfov = 3\n", 2, "did you mean camera?"},
    {"unknown list", "\n[[shpere]]\nradius = 1\n", 2, "did you mean sphere?"},
    {"a list's kind of another program", "[[disk]]\n", 1, "did you mean ring?"},
    {"a table of another program", "[background]\n", 1, "did you mean environment?"},
    {"unknown table, unlike any", "[xyzzyxyzzy]\n", 1, "known are camera"},
    {"list where a table is wanted", "[[camera]]\nfov = 3\n", 1, "write [camera]"},
    {"table where a list is wanted", "[sphere]\nradius = 3\n", 1, "write [[sphere]]"},
    {"number where a table is wanted", "film = 3\n", 1, "write [film]"},
    {"numbers where tables are wanted", "\nsphere = [1, 2]\n", 2, "write [[sphere]]"},
    {"a date", "[film]\nwidth = 1979-05-27\n", 2, "date"},
};

constexpr Broken toml_meaning[] = {
    {"unknown key", "[shading]\nmax_depth = 3\n", 2, "did you mean max_bounces?"},
    {"samples of another program", "[sampler]\nspp = 3\n", 2, "did you mean samples?"},
    {"word for a number", "[[sphere]]\ncenter = [0, 0, 0]\nradius = \"big\"\n", 3, "is a string"},
    {"number for a word", "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nname = 3\n", 4, "string"},
    {"no radius", "[[sphere]]\ncenter = [0, 0, 0]\n", 1, "has no 'radius'"},
    {"radius 0", "[[sphere]]\ncenter = [0, 0, 0]\nradius = 0\n", 3, "greater than 0"},
    {"radius below 0", "[[sphere]]\ncenter = [0, 0, 0]\nradius = -1.5\n", 3, "greater than 0"},
    {"radius nan", "[[sphere]]\ncenter = [0, 0, 0]\nradius = nan\n", 3, "'radius' is nan"},
    {"radius infinite", "[[sphere]]\ncenter = [0, 0, 0]\nradius = inf\n", 3, "'radius' is inf"},
    {"nan in a point", "[[sphere]]\ncenter = [0, nan, 0]\nradius = 1\n", 2, "nan"},
    {"nan in a line of its own", "[[sphere]]\nradius = 1\ncenter = [0,\n nan,\n 0]\n", 4, "nan"},
    {"point of two", "[[sphere]]\ncenter = [0, 0]\nradius = 1\n", 2, "'center'"},
    {"word in a point", "[[sphere]]\ncenter = [0, \"a\", 0]\nradius = 1\n", 2, "a string"},
    {"unknown material", "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"gold\"\n", 4,
     "unknown material 'gold'"},
    {"a name twice",
     "[[material]]\nname = \"a\"\n[[sphere]]\nname = \"a\"\ncenter = [0, 0, 0]\n"
     "radius = 1\n",
     4, "taken"},
    {"negative mass", "[[mass]]\ncenter = [0, 0, 0]\nmass = -1\n", 3, "'mass' is -1"},
    {"mass without center", "[[mass]]\nmass = 1\n", 1, "has no 'center'"},
    {"horizon without mass", "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nhorizon = true\n", 4,
     "horizon"},
    {"five corners", "[[quad]]\nvertices = [[0,0,0],[1,0,0],[2,1,0],[1,2,0],[0,1,0]]\n", 2,
     "'vertices'"},
    {"quad not planar", "[[quad]]\nvertices = [[0,0,0],[1,0,0],[1,1,0.5],[0,1,0]]\n", 2, "plan"},
    {"portal without pair", "[[portal]]\nvertices = [[0,0,0],[1,0,0],[1,1,0],[0,1,0]]\n", 1,
     "has no 'pair'"},
    {"pair that is not there",
     "[[portal]]\npair = \"b\"\nvertices = [[0,0,0],[1,0,0],[1,1,0],[0,1,0]]\n", 2,
     "no portal has the name 'b'"},
    {"portal paired with itself",
     "[[portal]]\nname = \"a\"\npair = \"a\"\nvertices = [[0,0,0],[1,0,0],[1,1,0],[0,1,0]]\n", 3,
     "its own pair"},
    {"pair that is not mutual",
     "[[portal]]\nname = \"a\"\npair = \"b\"\nvertices = [[0,0,0],[1,0,0],[1,1,0],[0,1,0]]\n"
     "[[portal]]\nname = \"b\"\npair = \"c\"\nvertices = [[0,0,9],[1,0,9],[1,1,9],[0,1,9]]\n"
     "[[portal]]\nname = \"c\"\npair = \"b\"\nvertices = [[0,0,5],[1,0,5],[1,1,5],[0,1,5]]\n",
     3, "names 'b' as its pair"},
    {"pair of another size",
     "[[portal]]\nname = \"a\"\npair = \"b\"\nvertices = [[0,0,0],[1,0,0],[1,1,0],[0,1,0]]\n"
     "[[portal]]\nname = \"b\"\npair = \"a\"\nvertices = [[0,0,9],[2,0,9],[2,2,9],[0,2,9]]\n",
     8, "congruent"},
    {"unknown integrator", "[physics]\nintegrator = \"eular\"\n", 2, "did you mean euler?"},
    {"unknown portal gravity", "[physics]\nportal_gravity = \"maps\"\n", 2, "graviton-map"},
    {"speed of light 0", "[physics]\nc = 0\n", 2, "'c' is 0"},
    {"no pixels", "[film]\nwidth = 0\n", 2, "'width' is 0"},
    {"too many pixels", "[film]\nwidth = 60000\nheight = 60000\n", 2, "pixels"},
    {"fraction of a pixel", "[film]\nwidth = 10.5\n", 2, "whole number"},
    {"samples as a list", "[sampler]\nsamples = [1]\n", 2, "whole number"},
    {"no samples", "[sampler]\nsamples = 0\n", 2, "'samples' is 0"},
    {"view of 180 degrees", "[camera]\nposition = [0, 0, 1]\nlook_at = [0, 0, 0]\nfov = 180.0\n", 4,
     "'fov'"},
    {"camera at what it looks at",
     "[camera]\nposition = [0, 0, 1]\nlook_at = [0, 0, 1]\nfov = 40.0\n", 3, "look"},
    {"unknown camera", "[camera]\ntype = \"fisheye\"\nposition = [0, 0, 1]\nlook_at = [0, 0, 0]\n",
     2, "perspective, orthographic"},
    {"missing picture", "[environment]\nimage = \"nothere.exr\"\n", 2, "no file"},
    {"picture outside", "[environment]\nimage = \"../outside.txt\"\n", 2, "leaves the folder"},
    {"absolute picture", "[environment]\nimage = \"/etc/hostname\"\n", 2, "leaves the folder"},
    {"device as a picture", "[environment]\nimage = \".\"\n", 2, "not a regular file"},
    {"words as a picture", "[[material]]\nname = \"m\"\ndiffuse = \"words.png\"\n", 3,
     "no known kind"},
    {"missing mesh", "[[mesh]]\nfile = \"nothere.obj\"\n", 2, "no file"},
    {"mesh without file", "[[mesh]]\nscale = 2\n", 1, "has no 'file'"},
    {"checker of one colour",
     "[[material]]\nname = \"m\"\ndiffuse = { checker = [[1, 1, 1]], size = 1.0 }\n", 3, "checker"},
    {"picture that goes on no way",
     "[[material]]\nname = \"m\"\ndiffuse = { image = \"nothere.png\", wrap = \"tile\" }\n", 3,
     "repeat, clamp, mirror"},
    {"picture with a size of three",
     "[[material]]\nname = \"m\"\ndiffuse = { image = \"nothere.png\", size = [1, 2, 3] }\n", 3,
     "two lengths"},
    {"picture with half an offset",
     "[[material]]\nname = \"m\"\ndiffuse = { image = \"nothere.png\", offset = [1] }\n", 3,
     "two numbers"},
    {"two kinds of surface in one",
     "[[material]]\nname = \"m\"\nbase_color = [1, 1, 1]\nreflective = [1, 1, 1]\n", 4,
     "of different surfaces"},
    {"metal beyond all", "[[material]]\nname = \"m\"\nmetallic = 1.5\n", 3, "metallic"},
    {"less dense than nothing", "[[material]]\nname = \"m\"\nior = 0.5\n", 3, "ior"},
    {"colour of two", "[[material]]\nname = \"m\"\ndiffuse = [1, 1]\n", 3, "diffuse"},
    {"light without intensity", "[[light]]\nposition = [0, 0, 0]\n", 1, "has no 'intensity'"},
    {"infinite reach with portals",
     "[physics]\nmin_force = 0\nportal_gravity = \"closest-point\"\n"
     "[[portal]]\nname = \"a\"\npair = \"b\"\nvertices = [[0,0,0],[1,0,0],[1,1,0],[0,1,0]]\n"
     "[[portal]]\nname = \"b\"\npair = \"a\"\nvertices = [[0,0,9],[1,0,9],[1,1,9],[0,1,9]]\n",
     2, "min_force"},
};

TEST(BrokenScene, WhatIsNotWellFormedTomlIsToldWithItsLine) {
  for (const Broken& broken : toml_form) expect_fault(".toml", broken);
}

TEST(BrokenScene, WhatHasNoMeaningIsToldWithItsLine) {
  for (const Broken& broken : toml_meaning) expect_fault(".toml", broken);
}

TEST(BrokenScene, AllFaultsOfAFileAreToldInOneGoByLine) {
  const TemporaryFolder folder;
  const auto faults = faults_of(folder.write(
      "a.toml", "[films]\n[shading]\nmax_depth = 3\n[[sphere]]\nradius = nan\n[[ball]]\n"));
  ASSERT_EQ(faults.size(), 5U) << all_of(faults);
  const int lines[] = {1, 3, 4, 5, 6};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(faults[i].where.line, lines[i]);
}

TEST(BrokenScene, ASyntaxErrorStandsAlone) {
  const TemporaryFolder folder;
  const auto faults = faults_of(folder.write("a.toml", "[films]\n[sphere]\nx = = 1\n[[ball]]\n"));
  ASSERT_EQ(faults.size(), 1U) << all_of(faults);
  EXPECT_EQ(faults[0].where.line, 3);
}

TEST(BrokenScene, AFileThatIsNoSceneIsRefusedAsAWhole) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "folder.toml");
  const std::pair<std::filesystem::path, const char*> cases[] = {
      {folder.path() / "nothere.toml", "no file"},
      {folder.path() / "folder.toml", "not a regular file"},
      {folder.write("empty.toml", ""), "empty"},
      {folder.write("empty.obj", ""), "empty"},
      {folder.write("scene.json", "{}"), "unknown suffix '.json'"},
      {folder.write("scene", "{}"), "no suffix"},
      {folder.write("big.toml", std::string((1 << 20) + 1, '#')), "at most 1 MiB"}};
  for (const auto& [file, phrase] : cases) {
    const auto faults = faults_of(file);
    ASSERT_EQ(faults.size(), 1U) << file;
    EXPECT_NE(to_string(faults[0]).find(phrase), std::string::npos) << to_string(faults[0]);
  }
}

TEST(BrokenScene, DepthThatWouldOverflowTheParserIsRefused) {
  const TemporaryFolder folder;
  std::string dotted = "a", nested(100000, '[');
  for (int i = 0; i < 100000; ++i) dotted += ".a";
  const std::pair<std::string, const char*> cases[] = {
      {"\n" + dotted + " = 1\n", "100000 dots"},
      {"\n[" + dotted + "]\n", "100000 dots"},
      {"\na = " + nested + "\n", "100000 deep"},
      {"\n'x' = '''y\n''' \n" + dotted + " = 1", "100000 dots"},
      {"\na = \"\\\"\" \n" + dotted + " = 1", "100000 dots"}};
  for (const auto& [text, phrase] : cases) {
    const auto faults = faults_of(folder.write("deep.toml", text));
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_NE(to_string(faults[0]).find(phrase), std::string::npos) << to_string(faults[0]);
  }
}

TEST(BrokenScene, DotsAndBracketsInStringsAndCommentsAreNotDepth) {
  const TemporaryFolder folder;
  const std::string many(1000, '.'), brackets(1000, '[');
  const auto file =
      folder.write("a.toml", "[[sphere]]\nname = '" + many + brackets + "' # " + many + brackets +
                                 "\ncenter = [0.5, 0.5, 0.5]\nradius = 1.5\n");
  EXPECT_TRUE(faults_of(file).empty()) << all_of(faults_of(file));
}

TEST(BrokenScene, TooManyObjectsAreRefusedWithAWayOut) {
  const TemporaryFolder folder;
  std::string text;
  for (int i = 0; i < 100001; ++i) text += "s 0 0 0 1\n";
  const auto faults = faults_of(folder.write("many.obj", text));
  ASSERT_FALSE(faults.empty());
  EXPECT_NE(all_of(faults).find("put them in a mesh"), std::string::npos);
}

TEST(BrokenScene, AFileOfFaultsIsNotToldForever) {
  const TemporaryFolder folder;
  std::string text;
  for (int i = 0; i < 100000; ++i) text += "v x\n";
  EXPECT_LT(faults_of(folder.write("bad.obj", text)).size(), 2000U);
}

/// What the program says, and how it ends.
std::pair<int, std::string> run(const std::string& arguments) {
  FILE* pipe = ::popen((std::string(PORTALENS_PROGRAM) + " " + arguments + " 2>&1").c_str(), "r");
  std::string said;
  char buffer[4096];
  while (std::fgets(buffer, sizeof buffer, pipe)) said += buffer;
  return {WEXITSTATUS(::pclose(pipe)), said};
}

TEST(BrokenScene, TheProgramTellsTheFaultEndsWithTwoAndWritesNothing) {
  const TemporaryFolder folder;
  const std::filesystem::path scenes[] = {
      folder.write("a.toml", "[film]\nwidth = 8\nheight = 8\n[shading]\nmax_depth = 3\n"),
      folder.write("b.toml", "[film\n"), folder.write("c.obj", "v 0 0 0\nf 1 2 3\n"),
      folder.path() / "nothere.toml"};
  for (const auto& scene : scenes) {
    const auto picture = folder.path() / "picture.png";
    const auto [code, said] = run("render " + scene.string() + " -o " + picture.string());
    EXPECT_EQ(code, 2) << said;
    EXPECT_NE(said.find(scene.filename().string()), std::string::npos) << said;
    EXPECT_FALSE(std::filesystem::exists(picture));
    EXPECT_EQ(run("check " + scene.string()).first, 2);
  }
  const auto entries = std::filesystem::directory_iterator(folder.path());
  EXPECT_EQ(std::distance(begin(entries), end(entries)), 3);
}

TEST(BrokenScene, NoCutOfAGoodFileCrashesTheReader) {
  const TemporaryFolder folder;
  const std::string toml =
      "[camera]\nposition = [0.0, 2.0, 12.0]\nlook_at = [0, 1.5, 0]\nfov = 40.0\n[[sphere]]\n"
      "name = \"hole\"\ncenter = [0, 1, 0]\nradius = 0.2\nmass = 1200.0\n";
  const std::string obj =
      "v 0 0 0 vt 0 0\nv 1 0 0 vt 1 0\nv 1 1 0 vt 1 1\nmaterial diffuse 1 1 1 reflective 0 0 0\n"
      "emitted 1 1 1\nf 1/1 2/2 3/3\nPerspectiveCamera { camera_position <0,0,1>\n"
      "point_of_interest <0,0,0> up <0,1,0> angle 30 }\n";
  for (std::size_t i = 1; i < toml.size(); ++i) {
    static_cast<void>(faults_of(folder.write("cut.toml", toml.substr(0, i))));
  }
  for (std::size_t i = 1; i < obj.size(); ++i) {
    static_cast<void>(faults_of(folder.write("cut.obj", obj.substr(0, i))));
  }
}

}  // namespace
}  // namespace portalens::test
