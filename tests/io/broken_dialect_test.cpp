// Broken scenes in the OBJ dialect: each fault is told with its line and a phrase that names it.
#include <gtest/gtest.h>

#include <vector>

#include "io/broken_files.h"

namespace portalens::test {
namespace {

constexpr Broken obj_form[] = {
    {"16-bit letters", "\xff\xfev 0 0 0\n", 0, "save it as UTF-8"},
    {"too few coordinates", "v 1 2\nv 1 2 3\n", 1, "too few values after 'v'"},
    {"too many coordinates", "v 1 2 3\nv 1 2 3 4\n", 2, "too many values after 'v'"},
    {"nan", "v 0 0 0\nv 0 nan 0\n", 2, "'nan' is not a finite number"},
    {"infinity", "v 0 inf 0\n", 1, "'inf' is not a finite number"},
    {"overflow", "v 0 1e999 0\n", 1, "not a finite number"},
    {"word for a number", "v 0 0 zero\n", 1, "'zero'"},
    {"number with a tail", "v 0 0 1.5m\n", 1, "'1.5m'"},
    {"hexadecimal", "v 0 0 0x10\n", 1, "'0x10'"},
    {"cut off", "v 0 0 0\nv 1", 2, "ends in the middle of 'v'"},
    {"unknown statement", "v 0 0 0\nsphere 0 0 0 1\n", 2, "unknown statement 'sphere'"},
    {"misspelt statement", "materail diffuse 1 1 1\n", 1, "did you mean material?"},
    {"index 0", "v 0 0 0 v 1 0 0 v 1 1 0\nf 0 1 2\n", 2, "no vertex 0"},
    {"negative index", "v 0 0 0 v 1 0 0 v 1 1 0\nf 3 -2 -3\n", 2, "no vertex -2"},
    {"index beyond", "v 0 0 0 v 1 0 0 v 1 1 0\nf 1 2 4\n", 2, "no vertex 4"},
    {"huge index", "v 0 0 0 v 1 0 0 v 1 1 0\nf 1 2 99999999999999999999\n", 2, "not a vertex"},
    {"index with a fraction", "v 0 0 0 v 1 0 0 v 1 1 0\nf 1 2 2.5\n", 2, "not a vertex"},
    {"two corners", "v 0 0 0 v 1 0 0 v 1 1 0\nf 1 2\nm 0", 2, "too few values after 'f'"},
    {"five corners", "m 0 v 0 0 0 v 1 0 0 v 1 1 0\nf 1 2 3 1 2\n", 2, "too many values after 'f'"},
    {"no such texture coordinate", "v 0 0 0 v 1 0 0 v 1 1 0\nf 1/1 2/1 3/1\n", 2, "'1/1'"},
    {"slash without index", "v 0 0 0 v 1 0 0 v 1 1 0\nf 1/ 2/ 3/\n", 2, "'1/'"},
    {"vt before v", "vt 0 0\nv 0 0 0\n", 1, "before any 'v'"},
    {"material without emitted", "material diffuse 1 1 1 reflective 0 0 0\nv 0 0 0\n", 1,
     "lacks emitted"},
    {"material without reflective", "material diffuse 1 1 1 emitted 0 0 0\n", 1,
     "lacks reflective"},
    {"two diffuse", "material diffuse 1 1 1\ntexture_file a.png reflective 0 0 0 emitted 0 0 0\n",
     2, "two of 'texture_file'"},
    {"material that is not there", "m 3\ns 0 0 0 1\n", 1, "no material 3"},
    {"negative material", "m -1\ns 0 0 0 1\n", 1, "at least 0"},
    {"one portal of a pair", "v 0 0 0 v 1 0 0 v 1 1 0 v 0 1 0\np 1 2 3 4 7\n", 2,
     "pair 7 has 1 portal"},
    {"three portals of a pair",
     "v 0 0 0 v 1 0 0 v 1 1 0 v 0 1 0\np 1 2 3 4 7\np 1 2 3 4 7\np 1 2 3 4 7\n", 4,
     "pair 7 has 3 portals"},
    {"portal of three corners", "v 0 0 0 v 1 0 0 v 1 1 0\np 1 2 3 0\n", 2, "no vertex 0"},
    {"mass before nothing", "s 0 0 0 1\nmass 3\n", 2, "no primitive follows"},
    {"two masses for one", "mass 3\nmass 4\ns 0 0 0 1\n", 1, "no primitive follows"},
    {"half a center of mass", "mass 3 1 2\ns 0 0 0 1\n", 1, "too few values after 'mass'"},
    {"physics without a value", "physics G\ns 0 0 0 1\n", 1, "too few values after 'physics'"},
    {"physics twice", "physics G 1\nphysics G 2\ns 0 0 0 1\n", 2, "given twice"},
    {"two backgrounds", "background_color 1 1 1\nbackground_color 0 0 0\n", 2, "a second"},
    {"background beyond white", "background_color 1 2 1\n", 1, "0 to 1"},
    {"camera without up",
     "PerspectiveCamera {\ncamera_position < 0, 0, 1 >\npoint_of_interest < 0, 0, 0 >\n"
     "angle 30\n}\n",
     1, "lacks its up"},
    {"camera without commas", "PerspectiveCamera {\ncamera_position < 0 0 1 >\n}\n", 2,
     "where ',' should stand"},
    {"camera never closed", "OrthographicCamera {\nsize 3\n", 1, "ends in the middle"},
    {"size of a perspective camera", "PerspectiveCamera {\nsize 3\n}\n", 2, "'size'"},
    {"two cameras",
     "OrthographicCamera { camera_position <0,0,1> point_of_interest <0,0,0> up <0,1,0> size 1 }\n"
     "OrthographicCamera { camera_position <0,0,1> point_of_interest <0,0,0> up <0,1,0> size 1 }\n",
     2, "a second camera"},
    {"ordinary OBJ in a scene", "m 0\nvn 0 0 1\n", 2, "ordinary OBJ"},
    {"nothing but a comment", "# nothing\n", 0, "no statement"},
    {"binary",
     "\x7f"
     "ELF\x02\x01\x01\n",
     1, "unknown statement"},
    {"negative radius", "\ns 0 0 0 -1\n", 2, "greater than 0"},
    {"unknown physics", "physics gravity 3\ns 0 0 0 1\n", 1, "unknown key 'gravity'"},
    {"missing texture",
     "material\ntexture_file no.png reflective 0 0 0 emitted 0 0 0\n"
     "s 0 0 0 1\n",
     2, "no file"},
};

TEST(BrokenScene, WhatIsNotTheObjDialectIsToldWithItsLine) {
  for (const Broken& broken : obj_form) expect_fault(".obj", broken);
}

TEST(BrokenScene, AllFaultsOfADialectFileAreToldInOneGoByLine) {
  const TemporaryFolder folder;
  const auto faults = faults_of(folder.write(
      "a.obj",
      "v 0 0\nv 1 0 0 v 0 1 0\nf 1 2 9\nfoo 1 2 3\ns 0 0 0 -1\nphysics cc 3\nm 4\ns 1 2 3\n"));
  std::vector<int> lines;
  for (const Fault& fault : faults) lines.push_back(fault.where.line);
  EXPECT_EQ(lines, (std::vector<int>{1, 3, 4, 5, 6, 8})) << all_of(faults);
}

}  // namespace
}  // namespace portalens::test
