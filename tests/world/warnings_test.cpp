// What is probably not meant is told, by name and with a remedy, and not without end.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "support/flush_scenes.h"
#include "support/scene_text.h"

namespace portalens {
namespace {

using test::compiled;

TEST(Compile, TheWarningsTellWhatIsProbablyNotMeant) {
  const World world = compiled(R"(
[camera]
position = [0, 0, 1]
look_at = [0, 0, 0]
[shading]
ambient = [0, 0, 0]
[environment]
color = [0, 0, 0]
[[material]]
name = "too bright"
diffuse = [0.8, 0.8, 0.8]
reflective = [0.5, 0, 0]
[[sphere]]
name = "sun"
center = [0, 0, 0]
radius = 0.5
mass = 2025
[[mass]]
name = "near"
center = [1, 0, 0]
mass = 1
[[mass]]
name = "bare"
center = [100, 0, 0]
mass = 1
horizon = false
[[portal]]
name = "a"
pair = "b"
vertices = [[30,0,0], [32,0,0], [32,2,0], [30,2,0]]
[[portal]]
name = "b"
pair = "a"
vertices = [[31,1,0], [33,1,0], [33,3,0], [31,3,0]]
)");
  std::string all;
  for (const std::string& warning : world.warnings) all += warning + "\n";
  const auto expected = {"within the horizon of 'sun'",
                         "'too bright' gives back more light",
                         "reaches 1.3",
                         "the horizons of 'sun' and 'near' overlap",
                         "'bare' has neither a horizon nor a core",
                         "the surface of 'sun' lies within its own horizon",
                         "portals 'a' and 'b' lie in one plane",
                         "nothing gives light"};
  for (const char* words : expected)
    EXPECT_NE(all.find(words), std::string::npos) << words << "\n" << all;
  EXPECT_EQ(world.warnings.size(), 7u) << all;
  ASSERT_EQ(world.remarks.size(), 1u);
  EXPECT_NE(world.remarks[0].find("within the influence of 'near'"), std::string::npos);
}

/// A pair of portals at x = 0 and x = 5, and what else is said.
std::string pair_and(const std::string& more, const std::string& of_portals = "") {
  return "[[portal]]\nname = \"a\"\npair = \"b\"\n" + of_portals +
         "vertices = [[0,0,0], [2,0,0], [2,2,0], [0,2,0]]\n"
         "[[portal]]\nname = \"b\"\npair = \"a\"\n"
         "vertices = [[5,0,0], [7,0,0], [7,2,0], [5,2,0]]\n" +
         more;
}

TEST(Compile, APullWithoutABoundIsAWarningThatNamesMassPortalAndRemedy) {
  const std::string heavy = "mass = 50\n";
  const World own = compiled(pair_and("", heavy));
  ASSERT_EQ(own.warnings.size(), 1u);
  for (const char* words : {"through portal 'b' light feels mass 'a' from its own place",
                            "no bound", "G M / c² = 0.0247", "core_radius", "portal 'a'"})
    EXPECT_NE(own.warnings[0].find(words), std::string::npos) << words << "\n" << own.warnings[0];
  for (const char* center : {"[6, 0, 0]", "[5, 2, 0]", "[6.3, 0.7, 0]", "[6, 1, 0.02]"})
    EXPECT_EQ(compiled(pair_and("[[mass]]\ncenter = " + std::string(center) + "\n" + heavy))
                  .warnings.size(),
              1u)
        << center;
  EXPECT_TRUE(compiled(pair_and("", heavy + "core_radius = 0.1\n")).warnings.empty());
  EXPECT_TRUE(compiled(pair_and("[[mass]]\ncenter = [6, 1, 0.1]\n" + heavy)).warnings.empty());
  for (const char* without : {"portal_gravity = \"none\"\n", "portal_gravity = \"portal-mass\"\n",
                              "portal_gravity_depth = 0\n"})
    EXPECT_TRUE(compiled(pair_and("[physics]\n" + std::string(without), heavy)).warnings.empty());
}

std::string warnings_of(const std::string& scene) {
  std::string all;
  for (const std::string& warning : compiled(scene).warnings) all += warning + "\n";
  return all;
}

std::string remarks_of(const std::string& scene) {
  std::string all;
  for (const std::string& remark : compiled(scene).remarks) all += remark + "\n";
  return all;
}

TEST(Compile, RemarksOnWhatHangsOnSomethingLargerAndTellsWhatIsSeen) {
  using namespace test;
  const std::string mirrored = mirror_on_a_wall + std::string("[shading]\nambient = [1, 1, 1]\n");
  for (const std::string& sound :
       {std::string(door_on_a_wall), mirrored, std::string(picture_on_a_wall),
        std::string(pairs_back_to_back), std::string(pair_in_one_place)})
    EXPECT_EQ(warnings_of(sound), "");
  EXPECT_EQ(
      remarks_of(door_on_a_wall),
      "'a' lies in the plane of 'quad0': where it is met, 'quad0' is not\n"
      "'b' lies in the plane of 'quad1', and the camera is behind it: from there 'quad1' is "
      "seen, not the portal; where that is not meant, list its corners in the other order, or "
      "give back = \"portal\"\n");
  EXPECT_EQ(remarks_of(mirrored),
            "'mirror0' lies in the plane of 'quad1': where both are, 'mirror0' is seen\n");
  EXPECT_EQ(
      remarks_of(picture_on_a_wall),
      "'the picture' lies in the plane of 'the wall': where both are, 'the picture' is seen\n");
  EXPECT_EQ(remarks_of(pairs_back_to_back), "");
  EXPECT_EQ(remarks_of(pair_in_one_place).find("plane"), std::string::npos);
}

TEST(Compile, WarnsOfTwoEqualSurfacesInOnePlace) {
  const std::string quad =
      "[[quad]]\nvertices = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]\n";
  EXPECT_NE(warnings_of(quad + quad)
                .find("'quad1' lies in the plane of 'quad0': where both are, "
                      "'quad1' is seen"),
            std::string::npos)
      << warnings_of(quad + quad);
  EXPECT_EQ(remarks_of(quad + quad), "");
}

/// A wall in the plane z = 0 and a room before it, with a lamp in the camera's place.
const char* const room =
    "[camera]\nposition = [0, 0, 5]\nlook_at = [0, 0, 0]\n"
    "[[light]]\nposition = [0, 0, 5]\nintensity = [10, 10, 10]\n"
    "[[quad]]\nname = \"wall\"\nvertices = [[-3, -3, 0], [3, -3, 0], [3, 3, 0], [-3, 3, 0]]\n";

std::string door_at(double z) {
  return "[[portal]]\nname = \"a\"\npair = \"b\"\ncenter = [0, 0, " + fmt::format("{}", z) +
         "]\nfacing = [0, 0, 1]\nup = [0, 1, 0]\nsize = [1, 2]\n"
         "[[portal]]\nname = \"b\"\npair = \"a\"\ncenter = [9, 0, 0]\nfacing = [0, 0, 1]\n"
         "up = [0, 1, 0]\nsize = [1, 2]\n";
}

std::string masses_along(int count, double apart) {
  std::string text = "[environment]\ncolor = [1, 1, 1]\n";
  for (int i = 0; i < count; ++i)
    text += "[[mass]]\ncenter = [" + std::to_string(i * apart) + ", 0, 0]\nmass = 1\n";
  return text;
}

TEST(Compile, WarnsOfABareMassButNotOfOneWithinASolid) {
  const auto body = [](const char* shape) {
    return room + std::string(shape) + "mass = 1\nhorizon = false\n";
  };
  const char* const bare = "has neither a horizon nor a core";
  EXPECT_EQ(warnings_of(body("[[sphere]]\ncenter = [0, 0, 2]\nradius = 0.5\n")).find(bare),
            std::string::npos);
  EXPECT_EQ(warnings_of(body("[[cube]]\ncenter = [0, 0, 2]\nsize = 0.5\n")).find(bare),
            std::string::npos);
  for (const char* shape : {"[[mass]]\ncenter = [0, 0, 2]\n",
                            "[[sphere]]\ncenter = [0, 0, 2]\nradius = 0.5\n"
                            "center_of_mass = [0, 0, 2.4]\n"})
    EXPECT_NE(warnings_of(body(shape)).find(bare), std::string::npos) << shape;
}

TEST(Compile, RemarksOnManyInfluencesInOneLine) {
  const std::string told = remarks_of(room + masses_along(30, 2.0));
  EXPECT_NE(told.find("the camera lies within the influences of "), std::string::npos) << told;
  EXPECT_EQ(told.find("the influence of 'mass0'"), std::string::npos) << told;
}

TEST(Compile, WarnsOfASceneWithoutAnything) {
  EXPECT_NE(warnings_of("# nothing yet\n").find("the scene has no object"), std::string::npos);
  EXPECT_EQ(warnings_of(room).find("the scene has no object"), std::string::npos);
}

TEST(Compile, WarnsOfColoursFrom0To255) {
  const std::string told =
      warnings_of(room + std::string("[[material]]\nname = \"green\"\ndiffuse = [0, 255, 0]\n"));
  EXPECT_NE(told.find("colours go from 0 to 1, not to 255"), std::string::npos) << told;
}

TEST(Compile, RemarksOnAViewThatMayBeInRadians) {
  const auto view = [](const char* fov) {
    return "[camera]\nposition = [0, 0, 5]\nlook_at = [0, 0, 0]\nfov = " + std::string(fov) +
           "\n[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\n";
  };
  EXPECT_EQ(remarks_of(view("0.8")),
            "the camera's fov is 0.8 degrees; if that was meant in radians, it is 45.84\n");
  EXPECT_EQ(remarks_of(view("8")), "");
}

TEST(Compile, WarnsOfADoorJustBehindItsWall) {
  EXPECT_EQ(
      warnings_of(room + door_at(-0.001)),
      "'wall' lies 0.001 before the front of portal 'a': nothing gets through; put the portal "
      "into that plane, or before it\n");
  for (const double z : {-1e-8, -1e-7, -1e-5, -0.015})
    EXPECT_NE(warnings_of(room + door_at(z)).find("nothing gets through"), std::string::npos) << z;
  EXPECT_EQ(warnings_of(room + door_at(0.0)), "");
  EXPECT_EQ(warnings_of(room + door_at(0.001)), "");
  EXPECT_EQ(warnings_of(room + door_at(-1.0)), "") << "another room may lie there";
}

TEST(Compile, RemarksOnAPictureJustBehindItsWall) {
  const auto picture_at = [](double z) {
    const std::string at = ", " + std::to_string(z) + "]";
    return "[[quad]]\nname = \"picture\"\nvertices = [[-1, -1" + at + ", [1, -1" + at + ", [1, 1" +
           at + ", [-1, 1" + at + "]\n";
  };
  EXPECT_EQ(remarks_of(room + picture_at(-0.001)),
            "'wall' lies 0.001 before 'picture' as the camera sees it, and hides it\n");
  EXPECT_EQ(remarks_of(room + picture_at(0.001)), "");
  EXPECT_EQ(remarks_of(room + picture_at(-1.0)), "");
}

TEST(Compile, RemarksOnPullsThatEndWhereTheyStillTurnLight) {
  const auto hole = [](const char* least) {
    return std::string("[physics]\nmin_force = ") + least +
           "\nc = 1.0\n[camera]\nposition = [0, 0, 50]\nlook_at = [0, 0, 0]\n[[mass]]\nname = "
           "\"hole\"\ncenter = [0, 0, 0]\nmass = 0.01\n"
           "[environment]\ncolor = [1, 1, 1]\n";
  };
  // m = 0.01 and R = 1: 2 m / R = 0.02 rad, and 4 m / R (1 - sqrt(3/4)) = 0.00536 rad.
  const std::string told = remarks_of(hole("0.01"));
  EXPECT_NE(told.find("the pull of 'hole' ends at 1, its radius of influence (physics.min_force): "
                      "light that passes there turns by 1.15 degrees less than by a pull without "
                      "end, at half of that by 0.307 degrees"),
            std::string::npos)
      << told;
  EXPECT_EQ(remarks_of(hole("1e-4")), "") << "at R = 10 it is 0.002 rad";
  EXPECT_EQ(remarks_of(hole("0.0")), "");
}

TEST(Compile, OverlapsAreToldByNameOnlyWhileTheyAreFew) {
  const World world = compiled(masses_along(300, 0.0));
  ASSERT_EQ(world.warnings.size(), 101u);
  EXPECT_EQ(world.warnings.front(), "the horizons of 'mass0' and 'mass1' overlap");
  EXPECT_EQ(world.warnings.back(), "44750 more pairs of horizons overlap");  // of 300 * 299 / 2
}

TEST(Compile, OverlapsAreLookedForOnlyAmongTheFirstOfVeryMany) {
  EXPECT_TRUE(compiled(masses_along(5000, 1.0)).warnings.empty());
  const World world = compiled(masses_along(5001, 1.0));
  ASSERT_EQ(world.warnings.size(), 1u);
  EXPECT_EQ(world.warnings[0],
            "of 5001 horizons the first 5000 were compared: others may overlap, too");
}

/// Two doors that stand beside each other, before a camera on +z.
std::string doors(const std::string& a, const std::string& b, const std::string& more = "") {
  return "[camera]\nposition = [0, 1, 8]\nlook_at = [0, 1, 0]\n[[portal]]\nname = \"a\"\npair = "
         "\"b\"\n" +
         more + "vertices = " + a + "\n[[portal]]\nname = \"b\"\npair = \"a\"\n" + more +
         "vertices = " + b + "\n";
}

TEST(Warnings, PortalsOfWhichTheCameraSeesOnlyOpenBacksAreTold) {
  const std::string front_a = "[[-3,0,0], [-1,0,0], [-1,2,0], [-3,2,0]]",
                    front_b = "[[1,0,0], [3,0,0], [3,2,0], [1,2,0]]",
                    back_a = "[[-3,0,0], [-3,2,0], [-1,2,0], [-1,0,0]]",
                    back_b = "[[1,0,0], [1,2,0], [3,2,0], [3,0,0]]";
  const auto told = [](const std::string& text) {
    return warnings_of(text).find("the camera is behind every portal ('a', 'b')") !=
           std::string::npos;
  };
  EXPECT_TRUE(told(doors(back_a, back_b)));
  EXPECT_FALSE(told(doors(front_a, front_b)));
  EXPECT_FALSE(told(doors(front_a, back_b)));  // one of them is seen
  EXPECT_FALSE(told(doors(back_a, back_b, "back = \"portal\"\n")));
}

TEST(Warnings, APairThatTurnsWhatStandsUprightIsTold) {
  const std::string a = "[[-3,0,0], [-1,0,0], [-1,2,0], [-3,2,0]]";
  const auto told = [](const std::string& text) {
    const std::string all = warnings_of(text);
    return all.substr(0, all.find('\n'));
  };
  EXPECT_EQ(told(doors(a, "[[1,0,0], [3,0,0], [3,2,0], [1,2,0]]")), "");
  EXPECT_EQ(told(doors(a, "[[1,0,0], [2.2,0,1.6], [2.2,2,1.6], [1,2,0]]")), "");
  EXPECT_NE(told(doors(a, "[[3,2,0], [1,2,0], [1,0,0], [3,0,0]]"))
                .find("up, (0, 1, 0), becomes (0, -1, 0)"),
            std::string::npos);
  EXPECT_NE(told(doors(a, "[[3,0,0], [3,2,0], [1,2,0], [1,0,0]]")).find("stand upright"),
            std::string::npos);
  // A door in the floor has no up of its own.
  EXPECT_EQ(told(doors(a, "[[1,0,2], [3,0,2], [3,0,0], [1,0,0]]")), "");
}

TEST(Warnings, ASceneThatNoLampLightsIsTold) {
  const std::string sky =
                        "[environment]\ncolor = [0.3, 0.5, 0.9]\n[camera]\nposition = [0, 0, 9]\n"
                        "look_at = [0, 0, 0]\n",
                    ball = "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\n",
                    glass = "material = \"m\"\n[[material]]\nname = \"m\"\n";
  const auto told = [](const std::string& text) {
    return warnings_of(text).find("no lamp lights the scene") != std::string::npos;
  };
  EXPECT_TRUE(told(sky + ball));
  EXPECT_FALSE(told(sky));
  EXPECT_FALSE(told(sky + ball + glass + "diffuse = [0, 0, 0]\nreflective = [0.9, 0.9, 0.9]\n"));
  EXPECT_FALSE(told(sky + ball + glass + "emitted = [1, 1, 1]\n"));
  EXPECT_FALSE(told(sky + ball + "[shading]\nambient = [0.9, 0.9, 0.9]\n"));
  EXPECT_FALSE(told(sky + ball + "[[light]]\nposition = [3, 5, 4]\nintensity = [50, 50, 50]\n"));
}

}  // namespace
}  // namespace portalens
