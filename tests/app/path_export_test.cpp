/// \file
/// `portalens trace -o`: files of paths, each opened by a reader that is not ours or is strict.
#include <gtest/gtest.h>
#include <tiny_obj_loader.h>

#include <array>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "support/run_program.h"

namespace portalens {
namespace {

using nlohmann::json;
using Point = std::array<double, 3>;

const std::string path_scene = R"(camera = { position = [0, 0, 9], look_at = [0, 0, 0] }
physics = { portal_gravity = "none" }
mass = [{ name = "the <hole> \"ä\"", center = [0, 0, 0], mass = 500 }]
quad = [{ name = "wall", vertices = [[-9, -9, -9], [9, -9, -9], [9, 9, -9], [-9, 9, -9]] }]
portal = [{ name = "in", pair = "out", vertices = [[2, -1, -2], [4, -1, -2], [4, 1, -2], [2, 1, -2]] },
          { name = "out", pair = "in", vertices = [[-4, 3, 0], [-2, 3, 0], [-2, 5, 0], [-4, 5, 0]] }]
)";

/// Into the hole, onto the wall, through the portal, away.
const std::string rays = "0 0 9 0 0 -1\n-3 -2 9 0 0 -1\n3 0 9 0.02 0.01 -1\n0 0 9 0 1 1\n";

struct Exported {
  json answers = json::array();  ///< with their paths
  std::string text;
  SceneFolder folder;
};

void export_paths(Exported& exported, const std::string& name,
                  const std::vector<std::string>& more = {}) {
  exported.folder.write("scene.toml", path_scene);
  std::vector<std::string> words = {"trace",  "scene.toml", "--rays", "-",
                                    "--json", "--path",     "-o",     name};
  words.insert(words.end(), more.begin(), more.end());
  const Outcome outcome = run_portalens(exported.folder.path(), words, rays);
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  std::istringstream lines(outcome.output);
  for (std::string line; std::getline(lines, line);) exported.answers.push_back(json::parse(line));
  ASSERT_EQ(exported.answers.size(), 4u);
  exported.text = exported.folder.read(name);
  ASSERT_FALSE(exported.text.empty());
}

/// The points of a stretch, as the answers tell them, without repeats.
std::vector<Point> points_of(const json& stretch) {
  std::vector<Point> points;
  for (const json& point : stretch)
    if (points.empty() || points.back() != point.get<Point>()) points.push_back(point.get<Point>());
  return points;
}

std::size_t stretch_count(const json& answers) {
  std::size_t count = 0;
  for (const json& answer : answers) count += answer["path"].size();
  return count;
}

TEST(PathExport, CsvHasEveryPointToTheLastDigit) {
  Exported exported;
  export_paths(exported, "a.csv");
  std::istringstream lines(exported.text);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "photon,stretch,index,x,y,z");
  for (std::size_t photon = 0; photon < 4; ++photon)
    for (std::size_t stretch = 0; stretch < exported.answers[photon]["path"].size(); ++stretch) {
      const auto points = points_of(exported.answers[photon]["path"][stretch]);
      for (std::size_t index = 0; index < points.size(); ++index) {
        ASSERT_TRUE(std::getline(lines, line));
        std::size_t p = 0, s = 0, i = 0;
        Point x{};
        ASSERT_EQ(
            std::sscanf(line.c_str(), "%zu,%zu,%zu,%lf,%lf,%lf", &p, &s, &i, &x[0], &x[1], &x[2]),
            6);
        ASSERT_EQ((std::array{p, s, i}), (std::array{photon, stretch, index}));
        ASSERT_EQ(x, points[index]);
      }
    }
  EXPECT_FALSE(std::getline(lines, line));
}

TEST(PathExport, ObjIsReadByTinyobjloader) {
  Exported exported;
  export_paths(exported, "a.obj");
  tinyobj::ObjReader reader;
  ASSERT_TRUE(reader.ParseFromString(exported.text, "")) << reader.Error();
  EXPECT_EQ(reader.Warning(), "");
  EXPECT_EQ(reader.GetShapes().size(), stretch_count(exported.answers));
  std::size_t next = 0;
  for (const auto& shape : reader.GetShapes()) {
    ASSERT_EQ(shape.lines.num_line_vertices.size(), 1u) << shape.name;
    EXPECT_EQ(static_cast<std::size_t>(shape.lines.num_line_vertices[0]),
              shape.lines.indices.size());
    EXPECT_GE(shape.lines.indices.size(), 2u);
    for (const auto& index : shape.lines.indices)
      EXPECT_EQ(static_cast<std::size_t>(index.vertex_index), next++);
  }
  EXPECT_EQ(reader.GetAttrib().vertices.size(), 3 * next);
  const json& last = exported.answers[1]["position"];
  bool found = false;
  for (std::size_t i = 0; i < next; ++i)
    found |= std::fabs(reader.GetAttrib().vertices[3 * i + 2] - last[2].get<float>()) < 1e-6f;
  EXPECT_TRUE(found) << "the wall is reached";
}

TEST(PathExport, PlyIsWhatItsHeaderSays) {
  Exported exported;
  export_paths(exported, "a.ply");
  std::istringstream lines(exported.text);
  std::string word;
  std::size_t vertices = 0, edges = 0;
  ASSERT_TRUE(std::getline(lines, word) && word == "ply");
  ASSERT_TRUE(std::getline(lines, word) && word == "format ascii 1.0");
  while (std::getline(lines, word) && word != "end_header") {
    std::sscanf(word.c_str(), "element vertex %zu", &vertices);
    std::sscanf(word.c_str(), "element edge %zu", &edges);
  }
  EXPECT_GT(vertices, 10u);
  EXPECT_EQ(edges, vertices - stretch_count(exported.answers));
  for (std::size_t i = 0; i < vertices; ++i) {
    double x = 0, y = 0, z = 0;
    int red = -1, green = -1, blue = -1;
    ASSERT_TRUE(lines >> x >> y >> z >> red >> green >> blue);
    ASSERT_TRUE(std::isfinite(x + y + z));
    for (const int color : {red, green, blue}) ASSERT_TRUE(color >= 0 && color <= 255);
  }
  for (std::size_t i = 0; i < edges; ++i) {
    std::size_t a = 0, b = 0;
    ASSERT_TRUE(lines >> a >> b);
    ASSERT_EQ(b, a + 1);
    ASSERT_LT(b, vertices);
  }
  EXPECT_FALSE(lines >> word);
}

std::string from_base64(const std::string& text) {
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    const std::size_t digit =
        std::string("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/").find(c);
    EXPECT_NE(digit, std::string::npos);
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    if ((count += 6) >= 8) bytes += static_cast<char>(bits >> (count -= 8) & 0xff);
  }
  return bytes;
}

/// What glTF 2.0 demands of accessors and of what they are used for.
class GltfReader {
 public:
  explicit GltfReader(const std::string& text) : gltf_(json::parse(text)) {
    const std::string uri = gltf_["buffers"][0]["uri"];
    const std::string start = "data:application/octet-stream;base64,";
    EXPECT_EQ(uri.substr(0, start.size()), start);
    bytes_ = from_base64(uri.substr(start.size()));
    EXPECT_EQ(bytes_.size(), gltf_["buffers"][0]["byteLength"]);
  }
  [[nodiscard]] const json& root() const { return gltf_; }

  template <class Number>
  std::vector<Number> values(const json& index) {
    const json& accessor = gltf_["accessors"].at(index.get<std::size_t>());
    const json& view = gltf_["bufferViews"].at(accessor["bufferView"].get<std::size_t>());
    EXPECT_EQ(accessor["componentType"], (std::is_same_v<Number, float> ? 5126 : 5125));
    const std::size_t count =
        accessor["count"].get<std::size_t>() * (accessor["type"] == "VEC3" ? 3 : 1);
    EXPECT_GT(count, 0u);
    const std::size_t offset = view["byteOffset"];
    EXPECT_EQ(offset % 4, 0u);
    EXPECT_EQ(view["byteLength"], 4 * count);
    std::vector<Number> numbers(count);
    if (offset + 4 * count > bytes_.size())
      ADD_FAILURE() << "the buffer ends too early";
    else
      std::memcpy(numbers.data(), bytes_.data() + offset, 4 * count);
    return numbers;
  }

 private:
  json gltf_;
  std::string bytes_;
};

void check_primitive(GltfReader& reader, const json& primitive, std::size_t corners) {
  const json& at = primitive["attributes"]["POSITION"];
  const auto positions = reader.values<float>(at);
  const json& accessor = reader.root()["accessors"][at.get<std::size_t>()];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    float low = positions[axis], high = positions[axis];
    for (std::size_t i = axis; i < positions.size(); i += 3) {
      ASSERT_TRUE(std::isfinite(positions[i]));
      low = std::min(low, positions[i]);
      high = std::max(high, positions[i]);
    }
    EXPECT_EQ(accessor["min"][axis].get<double>(), low);
    EXPECT_EQ(accessor["max"][axis].get<double>(), high);
  }
  const auto indices = reader.values<std::uint32_t>(primitive["indices"]);
  EXPECT_EQ(indices.size() % corners, 0u);
  for (const std::uint32_t index : indices) ASSERT_LT(index, positions.size() / 3);
  if (!primitive["attributes"].contains("COLOR_0")) return;
  const auto colors = reader.values<float>(primitive["attributes"]["COLOR_0"]);
  EXPECT_EQ(colors.size(), positions.size());
  for (const float color : colors) ASSERT_TRUE(color >= 0.0f && color <= 1.0f);
}

TEST(PathExport, GltfHoldsTogetherAndShowsPhotonsPortalsAndMasses) {
  for (const char* color : {"fate", "turning"}) {
    Exported exported;
    export_paths(exported, "a.gltf", {"--color", color});
    GltfReader reader(exported.text);
    const json& root = reader.root();
    EXPECT_EQ(root["asset"]["version"], "2.0");
    ASSERT_EQ(root["meshes"].size(), 4u);
    ASSERT_EQ(root["nodes"].size(), 4u);
    EXPECT_EQ(root["scenes"][0]["nodes"], json({0, 1, 2, 3}));
    const char* names[] = {"photons", "in", "out"};
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(root["nodes"][i]["mesh"], i);
      if (i < 3) {
        EXPECT_EQ(root["nodes"][i]["name"], names[i]);
      }
      const json& primitive = root["meshes"][i]["primitives"][0];
      EXPECT_EQ(primitive["mode"], i == 0 ? 1 : 4);
      EXPECT_EQ(primitive["attributes"].contains("COLOR_0"), i == 0);
      check_primitive(reader, primitive, i == 0 ? 2 : 3);
    }
  }
}

TEST(PathExport, SvgIsWellFormedAndNamesTheBodies) {
  for (const char* view : {"top", "front", "side"}) {
    Exported exported;
    export_paths(exported, "a.svg", {"--plan", view});
    const Outcome parsed =
        run_shell(exported.folder.path(),
                  "python3 -c 'import xml.dom.minidom as m; d = m.parse(\"a.svg\"); "
                  "print(*[t.firstChild.data for t in d.getElementsByTagName(\"text\") "
                  "if t.getAttribute(\"class\").endswith(\" name\")], "
                  "sum(p.getAttribute(\"class\") == \"path\" "
                  "for p in d.getElementsByTagName(\"path\")), sep=\"|\")'");
    EXPECT_EQ(parsed.code, 0) << parsed.errors;
    for (const std::string body : {"the <hole> \"ä\"|", "in|", "out|", "wall|"})
      EXPECT_NE(('|' + parsed.output).find('|' + body), std::string::npos) << parsed.output;
    EXPECT_TRUE(
        parsed.output.ends_with('|' + std::to_string(stretch_count(exported.answers)) + '\n'))
        << parsed.output;
  }
}

/// The colours of the paths, as SVG has them.
std::set<std::string> colors_of_ways(const std::string& svg) {
  std::set<std::string> colors;
  const std::regex way("<path class=\"path\" stroke=\"(#[0-9a-f]{6})\"");
  for (std::sregex_iterator i(svg.begin(), svg.end(), way), end; i != end; ++i)
    colors.insert((*i)[1]);
  return colors;
}

TEST(PathExport, ADrawingColorsWaysByFateOrByTurning) {
  Exported by_fate, by_turning, as_picture;
  export_paths(by_fate, "a.svg", {"--color", "fate"});
  export_paths(by_turning, "a.svg", {"--color", "turning"});
  export_paths(as_picture, "a.png", {"--plan", "side"});
  EXPECT_EQ(colors_of_ways(by_fate.text).size(), 3u) << "absorbed, hit, escaped";
  EXPECT_GT(colors_of_ways(by_turning.text).size(), 3u);
  EXPECT_EQ(as_picture.text.substr(1, 3), "PNG");
  const Outcome drawn = run_shell(by_fate.folder.path(),
                                  quoted({PORTALENS_PROGRAM, "draw", "scene.toml", "--rays", "-",
                                          "--view", "top", "--color", "turning", "-o", "b.svg"}),
                                  rays);
  ASSERT_EQ(drawn.code, 0) << drawn.errors;
  EXPECT_EQ(colors_of_ways(by_fate.folder.read("b.svg")), colors_of_ways(by_turning.text));
}

TEST(PathExport, NeedsAPlaceAndAKind) {
  const SceneFolder folder;
  folder.write("scene.toml", path_scene);
  for (const char* place : {"a.stl", "no/such/a.obj"}) {
    const Outcome outcome =
        run_portalens(folder.path(), {"trace", "scene.toml", "--pixel", "1", "1", "-o", place});
    EXPECT_EQ(outcome.code, place == std::string("a.stl") ? 2 : 1);
    EXPECT_NE(outcome.errors.find(place), std::string::npos);
  }
  EXPECT_EQ(folder.size(), 1u);
}

}  // namespace
}  // namespace portalens
