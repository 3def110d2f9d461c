// What lies in one plane, or within a closed surface: told where it was probably not meant.
#include <gtest/gtest.h>

#include <string>

#include "support/scene_text.h"

namespace portalens {
namespace {

using test::compiled;

std::string joined(const std::vector<std::string>& sentences) {
  std::string all;
  for (const std::string& sentence : sentences) all += sentence + "\n";
  return all;
}

bool says(const std::vector<std::string>& sentences, const std::string& words) {
  return joined(sentences).find(words) != std::string::npos;
}

/// Seen from z = 5, or from elsewhere, and lit.
std::string seen_from(const std::string& position) {
  return "[camera]\nposition = " + position +
         "\nlook_at = [0, 0.1, 0]\nup = [0, 0.9, 0.1]\n[shading]\nambient = [1, 1, 1]\n";
}

const std::string floor_and_box =
    "[[quad]]\nname = \"floor\"\nvertices = [[-4, 0, 4], [4, 0, 4], [4, 0, -4], [-4, 0, -4]]\n"
    "[[cube]]\nname = \"box\"\ncenter = [0, 0.5, 0]\nsize = 1\n";

TEST(Flush, WhatStandsOnAFloorIsToldOnlyToACameraBelow) {
  const std::string told = "'box' lies in the plane of 'floor': where both are, 'box' is seen";
  const World above = compiled(seen_from("[0, 1, 5]") + floor_and_box);
  const World below = compiled(seen_from("[0, -1, 5]") + floor_and_box);
  EXPECT_EQ(joined(above.warnings) + joined(above.remarks), "");
  EXPECT_EQ(joined(below.warnings), "");
  EXPECT_TRUE(says(below.remarks, told)) << joined(below.remarks);
}

/// A wall, and a door in it that faces +z or -z; its pair, that faces elsewhere; another pair.
std::string door_that_faces(const std::string& facing, const std::string& more = "",
                            const std::string& other_facing = "[0, 0, -1]") {
  const auto portal = [&](const std::string& name, const std::string& pair,
                          const std::string& place) {
    return "[[portal]]\nname = \"" + name + "\"\npair = \"" + pair + "\"\n" + place +
           "size = [1, 2]\n" + more;
  };
  return "[[quad]]\nname = \"wall\"\nvertices = [[-4, -4, 0], [4, -4, 0], [4, 4, 0], [-4, 4, "
         "0]]\n" +
         portal("door", "other", "center = [0, 0, 0]\nfacing = " + facing + "\n") +
         portal("other", "door", "center = [2, 0, 1]\nfacing = " + other_facing + "\n") +
         portal("c", "d", "center = [-2, 0, 1]\nfacing = [0, 0, 1]\n") +
         portal("d", "c", "center = [-2, 0, 3]\nfacing = [0, 0, 1]\n");
}

TEST(Flush, ADoorThatTurnsItsBackToTheCameraIsAWarning) {
  const std::string turned = "the camera is behind it: from there 'wall' is seen, not the portal";
  const World right = compiled(seen_from("[0, 0, 5]") + door_that_faces("[0, 0, 1]"));
  EXPECT_EQ(joined(right.warnings), "");
  EXPECT_TRUE(says(right.remarks, "where it is met, 'wall' is not")) << joined(right.remarks);
  const World wrong = compiled(seen_from("[0, 0, 5]") + door_that_faces("[0, 0, -1]"));
  EXPECT_TRUE(says(wrong.warnings, turned)) << joined(wrong.warnings);
  EXPECT_FALSE(says(wrong.remarks, "where it is met"));
  const World one_of_them =
      compiled(seen_from("[0, 0, 5]") + door_that_faces("[0, 0, -1]", "", "[0, 0, 1]"));
  EXPECT_EQ(joined(one_of_them.warnings), "");
  EXPECT_TRUE(says(one_of_them.remarks, turned)) << joined(one_of_them.remarks);
  const World with_two_sides =
      compiled(seen_from("[0, 0, 5]") + door_that_faces("[0, 0, -1]", "back = \"portal\"\n"));
  EXPECT_FALSE(says(with_two_sides.warnings, turned));
  // Behind a screen it is but a remark: another room may be there.
  const std::string screen =
      "[[quad]]\nvertices = [[-3, -3, 0.5], [3, -3, 0.5], [3, 3, 0.5], [-3, 3, 0.5]]\n";
  const World behind = compiled(seen_from("[0, 0, 5]") + door_that_faces("[0, 0, -1]") + screen);
  EXPECT_FALSE(says(behind.warnings, turned));
  EXPECT_TRUE(says(behind.remarks, turned));
}

const std::string ball = "[[sphere]]\nname = \"ball\"\ncenter = [0, 0, 0]\nradius = 1\n";

std::string lamp_at(const std::string& place, const std::string& intensity = "[9, 9, 9]") {
  return "[[light]]\nname = \"lamp\"\nposition = " + place + "\nintensity = " + intensity + "\n";
}

TEST(Enclosed, ALampWithinASolidIsAWarning) {
  const std::string told = "light 'lamp' lies within 'ball', and lights nothing but its inside";
  const std::string seen = seen_from("[0, 0, 5]");
  for (const char* place : {"[0, 0, 0]", "[0.5, 0.5, 0.6]", "[0, -0.99, 0]"})
    EXPECT_TRUE(says(compiled(seen + ball + lamp_at(place)).warnings, told)) << place;
  for (const char* place : {"[0, 0, 1.01]", "[0.8, 0.8, 0]", "[0, 4, 0]"})
    EXPECT_FALSE(says(compiled(seen + ball + lamp_at(place)).warnings, told)) << place;
  // A portal may lead in.
  const World portals = compiled(seen + ball + lamp_at("[0, 0, 0]") + door_that_faces("[0, 0, 1]"));
  EXPECT_TRUE(says(portals.remarks, told)) << joined(portals.remarks);
  EXPECT_FALSE(says(portals.warnings, told));
}

TEST(Enclosed, ACameraInARoomWithItsLampIsARemarkAndNoMore) {
  const World world = compiled(seen_from("[0, 0.2, 0.3]") + ball + lamp_at("[0, 0.5, 0]"));
  EXPECT_EQ(joined(world.warnings), "");
  EXPECT_EQ(joined(world.remarks), "the camera lies within 'ball': it sees the inside\n");
}

TEST(Enclosed, WhatStandsInARoomBesideTheCameraIsNone) {
  const std::string room = "[[cube]]\nname = \"room\"\ncenter = [0, 0, 0]\nsize = 12\n";
  const std::string things =
      "[[sphere]]\ncenter = [0, -1, 4]\nradius = 0.5\n"
      "[[cube]]\ncenter = [2, 1, 0]\nsize = 0.5\n";
  const World world = compiled(seen_from("[0, 0, 4]") + room + things + lamp_at("[0, 5, 0]"));
  EXPECT_EQ(joined(world.warnings), "");
}

TEST(Enclosed, ASurfaceWithinAnotherIsAWarning) {
  const auto inner = [](const std::string& center) {
    return "[[cube]]\nname = \"inner\"\ncenter = " + center + "\nsize = 0.5\n";
  };
  const std::string told = "'inner' lies within 'ball': it is not seen from outside";
  const std::string seen = seen_from("[0, 0, 5]");
  EXPECT_TRUE(says(compiled(seen + ball + inner("[0, 0.1, 0]")).warnings, told));
  for (const char* place : {"[0, 0, 0.9]", "[0, 2, 0]"})
    EXPECT_FALSE(says(compiled(seen + ball + inner(place)).warnings, told)) << place;
  EXPECT_FALSE(
      says(compiled(seen_from("[0, 0.7, 0.4]") + ball + inner("[0, 0.1, 0]")).warnings, told));
}

TEST(Enclosed, ALampWithoutLightIsARemark) {
  const std::string told = "light 'lamp' gives no light";
  const std::string seen = seen_from("[0, 0, 5]");
  EXPECT_TRUE(says(compiled(seen + ball + lamp_at("[0, 3, 0]", "[0, 0, 0]")).remarks, told));
  EXPECT_FALSE(says(compiled(seen + ball + lamp_at("[0, 3, 0]", "[0, 1, 0]")).remarks, told));
}

TEST(Enclosed, ASunFromBelowIsARemark) {
  const auto sun = [](const std::string& direction) {
    return "[[light]]\nname = \"sun\"\ntype = \"sun\"\nintensity = 1\ndirection = " + direction +
           '\n';
  };
  const std::string told = "light 'sun' shines from below";
  const std::string seen = seen_from("[0, 0, 5]");
  EXPECT_TRUE(says(compiled(seen + ball + sun("[0, 1, 0]")).remarks, told));
  EXPECT_FALSE(says(compiled(seen + ball + sun("[1, -0.2, 0]")).remarks, told));
}

}  // namespace
}  // namespace portalens
