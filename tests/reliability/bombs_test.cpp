// Files made to hurt: each is refused with a message, soon, whatever it claims, nests or names.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <time.h>

#include <functional>
#include <string>
#include <vector>

#include "io/read_scene.h"
#include "support/run_program.h"
#include "support/sanitized.h"
#include "support/scale.h"
#include "world/compile.h"

namespace portalens {
namespace {

namespace fs = std::filesystem;

struct Bomb {
  std::string title;
  std::function<std::string(const SceneFolder&)>
      lay;  ///< returns what the program is told to check
};

std::string repeated(const std::string& text, std::size_t times) {
  std::string result;
  for (std::size_t i = 0; i < times; ++i) result += text;
  return result;
}

constexpr std::size_t mega = 1'000'000;

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

const std::string names_picture = "[environment]\nimage = \"p\"\n";

Bomb picture(const std::string& title, const std::string& bytes) {
  return {title, [=](const SceneFolder& folder) {
            folder.write("p", bytes);
            folder.write("scene.toml", names_picture);
            return std::string("scene.toml");
          }};
}

/// A file of which `make` decides what it is.
Bomb file(const std::string& title, const std::string& name, const std::string& scene,
          const std::function<void(const fs::path&)>& make) {
  return {title, [=](const SceneFolder& folder) {
            if (!scene.empty()) folder.write("scene.toml", scene);
            make(folder.path() / name);
            return scene.empty() ? name : std::string("scene.toml");
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
      mesh("mesh: a hundred thousand materials that are not there",
           corner + repeated("usemtl x\nf 1 2 3\n", 100'000)),
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

std::string little(std::uint32_t number) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(number >> (8 * i));
  return bytes;
}

std::string big(std::uint32_t number) {
  const std::string bytes = little(number);
  return {bytes.rbegin(), bytes.rend()};
}

/// The checksum of PNG's chunks; ISO 15948, annex D.
std::uint32_t checksum(const std::string& bytes) {
  std::uint32_t sum = 0xffffffffU;
  for (const char byte : bytes) {
    sum ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) sum = (sum & 1U) ? 0xedb88320U ^ (sum >> 1) : sum >> 1;
  }
  return ~sum;
}

std::string png(std::uint32_t width, std::uint32_t height) {
  const auto chunk = [](const std::string& body) {
    return big(static_cast<std::uint32_t>(body.size() - 4)) + body + big(checksum(body));
  };
  return "\x89PNG\r\n\x1a\n" +
         chunk("IHDR" + big(width) + big(height) + std::string("\x08\x02\x00\x00\x00", 5)) +
         chunk(std::string("IDAT\x78\x9c\x03\x00\x00\x00\x00\x01", 12)) + chunk("IEND");
}

std::string exr(const std::string& more, std::uint32_t width, std::uint32_t height) {
  const auto attribute = [](const std::string& name, const std::string& type,
                            const std::string& value) {
    return name + '\0' + type + '\0' + little(static_cast<std::uint32_t>(value.size())) + value;
  };
  const std::string window = little(0) + little(0) + little(width - 1) + little(height - 1);
  const std::string channel = std::string("Y\0", 2) + little(1) + little(0) + little(1) + little(1);
  return "\x76\x2f\x31\x01" + little(2) + more + attribute("channels", "chlist", channel + '\0') +
         attribute("compression", "compression", std::string(1, '\0')) +
         attribute("dataWindow", "box2i", window) + attribute("displayWindow", "box2i", window) +
         attribute("lineOrder", "lineOrder", std::string(1, '\0')) +
         attribute("pixelAspectRatio", "float", std::string("\0\0\x80\x3f", 4)) +
         attribute("screenWindowCenter", "v2f", std::string(8, '\0')) +
         attribute("screenWindowWidth", "float", std::string("\0\0\x80\x3f", 4)) + '\0';
}

std::vector<Bomb> picture_bombs() {
  const std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
  const std::string jpeg = std::string("\xff\xd8\xff\xc0\x00\x11\x08\xff\xff\xff\xff\x03", 12) +
                           std::string("\x01\x11\0\x02\x11\0\x03\x11\0", 9);
  return {
      picture("a PNG that claims 100,000 x 100,000", png(100'000, 100'000)),
      picture("a PNG that claims 16384 x 8192 and is empty", png(16384, 8192)),
      picture("a PNG that claims 4294967295 x 1", png(4294967295U, 1)),
      picture("a PNG cut off", png(8, 8).substr(0, 40)),
      picture("an HDR that claims 1e9 x 1e9", hdr + "-Y 1000000000 +X 1000000000\n"),
      picture("an HDR that claims 8192 x 16384 and is empty", hdr + "-Y 8192 +X 16384\n"),
      picture("an HDR that claims less than nothing", hdr + "-Y -5 +X -5\n"),
      picture("an EXR that claims 100,000 x 100,000", exr("", 100'000, 100'000)),
      picture("an EXR that claims 16384 x 8192 and is empty", exr("", 16384, 8192)),
      picture("an EXR with an attribute of 2 GB",
              exr(std::string("a\0string\0", 9) + little(0x7fffffff), 4, 4)),
      picture("an EXR with an attribute of less than nothing",
              exr(std::string("a\0string\0", 9) + little(0xffffffff), 4, 4)),
      picture("an EXR with tiles of 16384 x 16384",
              exr(std::string("tiles\0tiledesc\0", 15) + little(9) + little(16384) + little(16384) +
                      '\0',
                  4, 4)),
      picture("an EXR that never ends its header",
              "\x76\x2f\x31\x01" + little(2) + std::string(mega, 'x')),
      picture("a JPEG that claims 65535 x 65535", jpeg),
      picture("a JPEG without a frame", std::string("\xff\xd8\xff\xda\x00\x08", 6)),
      picture("words for a picture", std::string(mega, 'w')),
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

/// Seconds of processor time that this thread took.
double spent() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// What the readers say of a scene; nothing if they take it.
std::string refusal_of(const fs::path& scene) {
  try {
    static_cast<void>(compile(read_scene(scene)));
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

void expect_refused(const std::vector<Bomb>& bombs) {
  // The program takes a quarter of a second to start: only in a long run does each bomb go through
  // it.
  const std::size_t every = test::test_scale() >= 10.0 ? 1 : bombs.size() / 2;
  for (std::size_t i = 0; i < bombs.size(); ++i) {
    const SceneFolder folder;
    const std::string scene = bombs[i].lay(folder);
    const double before = spent();
    const std::string refusal = refusal_of(folder.path() / scene);
    EXPECT_LT(spent() - before, sanitized ? 20.0 : 2.0) << bombs[i].title;
    EXPECT_NE(refusal, "") << bombs[i].title;
    EXPECT_LT(refusal.size(), 400'000u) << bombs[i].title;
    if (i % every != 0) continue;
    const Outcome outcome =
        run_shell(folder.path(), "timeout 60" + quoted({PORTALENS_PROGRAM, "check", scene}));
    EXPECT_EQ(outcome.code, 2) << bombs[i].title << ": " << outcome.errors.substr(0, 500);
    EXPECT_FALSE(outcome.errors.empty()) << bombs[i].title;
  }
}

TEST(Bombs, OfTomlAreRefused) { expect_refused(toml_bombs()); }
TEST(Bombs, OfTheDialectAreRefused) { expect_refused(dialect_bombs()); }
TEST(Bombs, OfMeshesAreRefused) { expect_refused(mesh_bombs()); }
TEST(Bombs, OfPicturesAreRefused) { expect_refused(picture_bombs()); }
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
  const std::size_t count = toml_bombs().size() + dialect_bombs().size() + mesh_bombs().size() +
                            picture_bombs().size() + path_bombs().size();
  EXPECT_GE(count, 50u);
}

}  // namespace
}  // namespace portalens
