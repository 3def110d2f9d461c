// Files made to hurt: each is refused with a message, soon, whatever it claims, nests or names.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <string>
#include <vector>

#include "reliability/bomb.h"

namespace portalens::test {
namespace {

Bomb toml(const std::string& title, const std::string& text) {
  return {title, [=](const SceneFolder& folder) {
            folder.write("scene.toml", text);
            return std::string("scene.toml");
          }};
}

Bomb dialect(const std::string& title, const std::string& text) {
  return {title, [=](const SceneFolder& folder) {
            folder.write("scene.obj", text);
            return std::string("scene.obj");
          }};
}

Bomb mesh(const std::string& title, const std::string& text, const std::string& mtl = "") {
  return {title, [=](const SceneFolder& folder) {
            folder.write("m.obj", text);
            folder.write("m.mtl", mtl);
            folder.write("scene.toml", "[[mesh]]\nfile = \"m.obj\"\n");
            return std::string("scene.toml");
          }};
}

std::string square_portals(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    const std::string z = std::to_string(i);
    text += "[[portal]]\nname = \"p" + z + "\"\npair = \"p" + std::to_string(i ^ 1) +
            "\"\nvertices = [[0,0," + z + "],[1,0," + z + "],[1,1," + z + "],[0,1," + z + "]]\n";
  }
  return text;
}

std::vector<Bomb> toml_bombs() {
  const std::string dots = repeated("a.", 100'000);
  std::string materials, pairs;
  for (int i = 0; i < 1000; ++i)
    materials += "[[material]]\nname = \"" + std::string(24, 'm') + std::to_string(i) + "\"\n";
  for (int i = 0; i < 12'000; ++i)
    pairs += "[[portal]]\npair = \"porta" + std::to_string(i) + "\"\n";
  const std::string unknown =
      "[[sphere]]\ncenter = [0,0,0]\nradius = 1\nmaterial = \"" + std::string(27, 'n') + "\"\n";
  return {
      toml("10,000 spheres of misspelt materials", materials + repeated(unknown, 10'000)),
      toml("12,000 portals of misspelt pairs", pairs),
      toml("lists 10,000 deep", "a = " + std::string(10'000, '[') + std::string(10'000, ']')),
      toml("tables 10,000 deep", "a = " + repeated("{a=", 10'000) + "1"),
      toml("a key of 100,000 dots", dots + "a = 1\n"),
      toml("a heading of 100,000 dots", "[" + dots + "a]\n"),
      toml("longer than is read", std::string(3 * mega, '#')),
      toml("nothing but brackets", std::string(mega, '[')),
      toml("nothing but quotes", std::string(mega, '"')),
      toml("nothing but zeros", std::string(mega, '\0')),
      toml("nothing but bytes of no letter", std::string(mega, '\xff')),
      toml("a string never closed", "[film]\nwidth = \"" + std::string(mega, 'x')),
      toml("a name of a million letters", "[[" + std::string(mega, 'x') + "]]\n"),
      toml("more objects than are read", repeated("[[mass]]\n", 110'000)),
      toml("a hundred thousand keys",
           [] {
             std::string text = "[film]\n";
             for (int i = 0; i < 100'000; ++i) text += "k" + std::to_string(i) + "=1\n";
             return text;
           }()),
      toml("a list of 300,000", "[camera]\nposition = [" + repeated("1,", 300'000) + "1]\n"),
      toml("a number without end", "[physics]\nG = 1" + std::string(mega, '0') + "\n"),
      toml("a power beyond all", "[physics]\nG = 1e999999999\n"),
      toml("a film of 1e9 x 1e9", "[film]\nwidth = 1000000000\nheight = 1000000000\n"),
      toml("a film of 65536 x 65536", "[film]\nwidth = 65536\nheight = 65536\n"),
      toml("more samples than can be", "[sampler]\nsamples = 9223372036854775807\n"),
      toml("a letter that trips the parser", "[film]\n\xcf\x8f = 1\n"),
      toml("a portal of 10,000 corners",
           "[[portal]]\npair = \"p\"\nvertices = [" + repeated("[0,0,0],", 10'000) + "]\n"),
      toml("gravity through 20 portals, 16 deep",
           "[physics]\nportal_gravity_depth = 16\n[[mass]]\ncenter = [9,9,9]\nmass = 1e6\n" +
               square_portals(20)),
      toml("graviton maps without end",
           "[physics]\nportal_gravity = \"graviton-map\"\ngraviton_resolution = 1024\n"
           "portal_gravity_depth = 8\n[[mass]]\ncenter = [9,9,9]\nmass = 1e6\n" +
               square_portals(20)),
  };
}

std::vector<Bomb> dialect_bombs() {
  const std::string corner = "v 0 0 0 v 1 0 0 v 1 1 0\n";
  return {
      dialect("index 99999999999", corner + "f 1 2 99999999999\n"),
      dialect("the least of all indices", corner + "f 1 2 -9223372036854775808\n"),
      dialect("a hundred thousand cameras", repeated("PerspectiveCamera {\n", 100'000)),
      dialect("more spheres than are read", repeated("s 0 0 0 1\n", 100'001)),
      dialect("more materials than are read",
              repeated("material diffuse 1 1 1 reflective 0 0 0 emitted 0 0 0\n", 10'001)),
      dialect("a number of a million digits", "v 0 0 " + std::string(mega, '9') + "\n"),
      dialect("a word of eight million letters", std::string(8 * mega, 'x')),
      dialect(
          "pairs of one portal", "v 0 0 0 v 1 0 0 v 1 1 0 v 0 1 0\n" +
                                     [] {
                                       std::string text;
                                       for (int i = 0; i < 50'000; ++i)
                                         text += "p 1 2 3 4 " + std::to_string(i) + "\n";
                                       return text;
                                     }()),
      dialect("a camera cut off", "PerspectiveCamera { camera_position < 1, 2"),
      dialect("noise",
              [] {
                std::string bytes(mega, ' ');
                unsigned state = 1;
                for (char& byte : bytes)
                  byte = static_cast<char>((state = state * 1664525U + 1013904223U) >> 24);
                return bytes;
              }()),
      file("a dialect file of 2 GiB", "scene.obj", "",
           [](const fs::path& path) {
             std::ofstream(path) << 's';
             fs::resize_file(path, std::uintmax_t{2} << 30);
           }),
  };
}

std::vector<Bomb> mesh_bombs() {
  const std::string corner = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const auto huge = [](std::uintmax_t size) {
    return [size](const fs::path& path) {
      std::ofstream(path) << 'v';
      fs::resize_file(path, size);
    };
  };
  return {
      mesh("mesh: index 99999999999", corner + "f 1 2 99999999999\n"),
      mesh("mesh: index 4294967295", corner + "f 1 2 4294967295\n"),
      mesh("mesh: a relative index before the first", corner + "f -1 -2 -4\n"),
      mesh("mesh: cut off in a face", corner + "f 1 2"),
      mesh("mesh: cut off in a number", "v 0 0 0\nv 1 0 0\nv 0 1 1e"),
      mesh("mesh: a face of a million corners", corner + "f " + repeated("1 ", mega) + "\n"),
      mesh("mesh: a million lines that go on", "v 0 0 0 " + repeated("\\\n", mega) + "f\n"),
      mesh("mesh: coordinates beyond floats", "v 0 0 1e300\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
      mesh(
          "mesh: two thousand MTL files that are not there",
          corner +
              [] {
                std::string text;
                for (int i = 0; i < 2000; ++i) text += "mtllib m" + std::to_string(i) + "\n";
                return text;
              }() +
              "f 1 2 3\n"),
      mesh("mesh: its materials outside the folder",
           "mtllib ../../etc/passwd\n" + corner + "f 1 2 3\n"),
      mesh("mesh: more materials than are read", "mtllib m.mtl\n" + corner + "f 1 2 3\n",
           [] {
             std::string text;
             for (int i = 0; i < 20'000; ++i) text += "newmtl m" + std::to_string(i) + "\n";
             return text;
           }()),
      file("a mesh of 2 GiB", "m.obj", "[[mesh]]\nfile = \"m.obj\"\n",
           huge(std::uintmax_t{2} << 30)),
  };
}

std::vector<Bomb> path_bombs() {
  const auto fifo = [](const fs::path& path) { ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0); };
  const auto link = [](const char* target) {
    return [=](const fs::path& path) { fs::create_symlink(target, path); };
  };
  const auto nothing = [](const fs::path&) {};
  const std::string names_mesh = "[[mesh]]\nfile = \"m.obj\"\n";
  return {
      file("a FIFO for a picture", "p", names_picture, fifo),
      file("a FIFO for a mesh", "m.obj", names_mesh, fifo),
      file("a FIFO for a scene", "scene.toml", "", fifo),
      file("a device for a scene", "scene.toml", "", link("/dev/zero")),
      file("a device for a mesh", "m.obj", names_mesh, link("/dev/zero")),
      file("links in a circle", "p", names_picture, link("p")),
      file("a link out of the folder", "p", names_picture, link("/etc/hostname")),
      file("a folder for a picture", "p", names_picture,
           [](const fs::path& path) { fs::create_directory(path); }),
      file("a picture outside", "p", "[environment]\nimage = \"../../etc/passwd\"\n", nothing),
      file("an absolute picture", "p", "[environment]\nimage = \"/etc/passwd\"\n", nothing),
      file("a name with a zero", "p", "[environment]\nimage = \"p\\u0000q\"\n", nothing),
      file("a name of 100,000 letters", "p",
           "[environment]\nimage = \"" + std::string(100'000, 'p') + "\"\n", nothing),
      file("a way of 10,000 folders", "p",
           "[environment]\nimage = \"" + repeated("a/", 10'000) + "p\"\n", nothing),
  };
}

TEST(Bombs, OfTomlAreRefused) { expect_refused(toml_bombs()); }
TEST(Bombs, OfTheDialectAreRefused) { expect_refused(dialect_bombs()); }
TEST(Bombs, OfMeshesAreRefused) { expect_refused(mesh_bombs()); }
TEST(Bombs, OfPathsAreRefused) { expect_refused(path_bombs()); }

TEST(Bombs, OfManyThingsInOnePlaceAreHeldInBounds) {
  if (sanitized) GTEST_SKIP() << "a sanitizer takes address space without end";
  const std::string place = "vertices = [[0,0,0], [2,0,0], [1,2,0]]\n";
  std::string portals;
  for (int i = 0; i < 6000; ++i)
    portals += "[[portal]]\nname = \"" + std::to_string(i) + "\"\npair = \"" +
               std::to_string(i ^ 1) + "\"\n" + place;
  const std::vector<std::string> many_masses = {
      repeated("[[mass]]\ncenter = [0,0,0]\nmass = 1\n", 26'000),
      repeated("[[sphere]]\ncenter = [0,0,0]\nradius = 1\n", 26'000), portals};
  for (const std::string& many : many_masses) {
    const SceneFolder folder;
    folder.write("scene.toml", many);
    const Outcome outcome =
        run_shell(folder.path(), "ulimit -v 4000000; timeout 60" +
                                     quoted({PORTALENS_PROGRAM, "check", "scene.toml"}));
    EXPECT_EQ(outcome.code, 0) << many.substr(0, 40) << outcome.errors.substr(0, 500);
    EXPECT_LT(outcome.output.size(), 4 * mega) << many.substr(0, 40);
  }
}

TEST(Bombs, AreFiftyAtLeast) {
  const std::size_t count =
      toml_bombs().size() + dialect_bombs().size() + mesh_bombs().size() + path_bombs().size();
  EXPECT_GE(count, 50u);
}

}  // namespace
}  // namespace portalens::test
