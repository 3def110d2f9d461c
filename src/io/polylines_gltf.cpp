// Paths of photons as glTF 2.0 (Khronos Group; ISO/IEC 12113:2022): one file, its buffer inside as
// base64. Positions and colours are floats, colours linear, as the format has them.
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string_view>
#include <utility>

#include "io/bits.h"
#include "io/polylines.h"
#include "math/triangulate.h"

namespace portalens {
namespace {

using Json = nlohmann::ordered_json;
using FloatTriple = std::array<float, 3>;

FloatTriple floats(Vec3d v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t j = 0; j < 3; ++j)
      group = group << 8 | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0u);
    for (std::size_t j = 0; j < 4; ++j)
      text += i + j <= bytes.size() ? digits[group >> (18 - 6 * j) & 63] : '=';
  }
  return text;
}

/// Corners and the triangles or line segments between them.
struct Solid {
  std::vector<FloatTriple> positions, colors;
  std::vector<std::uint32_t> indices;
};

/// Puts a document together, piece by piece.
class Document {
 public:
  void add_lines(const std::string& name, const Solid& solid) { add(name, solid, {{"mode", 1}}); }

  void add_triangles(const std::string& name, const Solid& solid, Rgb color, double opacity) {
    const auto share = [](double channel) { return std::clamp(channel, 0.0, 1.0); };
    const std::size_t material =
        append("materials",
               {{"name", name},
                {"doubleSided", true},
                {"alphaMode", opacity < 1.0 ? "BLEND" : "OPAQUE"},
                {"pbrMetallicRoughness",
                 {{"baseColorFactor", {share(color.x), share(color.y), share(color.z), opacity}},
                  {"metallicFactor", 0},
                  {"roughnessFactor", 1}}}});
    add(name, solid, {{"mode", 4}, {"material", material}});
  }

  [[nodiscard]] std::string text() && {
    if (!bytes_.empty())
      append("buffers", {{"byteLength", bytes_.size()},
                         {"uri", "data:application/octet-stream;base64," + base64(bytes_)}});
    // Names need not be UTF-8.
    return root_.dump(-1, ' ', true, Json::error_handler_t::replace) + '\n';
  }

 private:
  /// Lists that are empty may not stand in a file.
  std::size_t append(const char* list, Json item) {
    root_[list].push_back(std::move(item));
    return root_[list].size() - 1;
  }

  /// Appends numbers of four bytes, little-endian; the index of their view.
  template <class Number>
  std::size_t view(const Number* numbers, std::size_t count, int target) {
    const std::size_t begin = bytes_.size();
    for (std::size_t i = 0; i < count; ++i) {
      const auto bits = bit_cast<std::uint32_t>(numbers[i]);
      for (int shift = 0; shift < 32; shift += 8) bytes_ += static_cast<char>(bits >> shift & 0xff);
    }
    return append(
        "bufferViews",
        {{"buffer", 0}, {"byteOffset", begin}, {"byteLength", 4 * count}, {"target", target}});
  }

  std::size_t triples(const std::vector<FloatTriple>& values, bool with_bounds) {
    Json accessor = {{"bufferView", view(values.front().data(), 3 * values.size(), 34962)},
                     {"componentType", 5126},
                     {"count", values.size()},
                     {"type", "VEC3"}};
    if (with_bounds) {
      FloatTriple low = values.front(), high = values.front();
      for (const FloatTriple& value : values)
        for (std::size_t c = 0; c < 3; ++c) {
          low[c] = std::min(low[c], value[c]);
          high[c] = std::max(high[c], value[c]);
        }
      accessor["min"] = low;
      accessor["max"] = high;
    }
    return append("accessors", std::move(accessor));
  }

  /// @param primitive  what is to be said besides its attributes
  void add(const std::string& name, const Solid& solid, Json primitive) {
    primitive["attributes"]["POSITION"] = triples(solid.positions, true);
    if (!solid.colors.empty()) primitive["attributes"]["COLOR_0"] = triples(solid.colors, false);
    const std::size_t count = solid.indices.size();
    primitive["indices"] =
        append("accessors", {{"bufferView", view(solid.indices.data(), count, 34963)},
                             {"componentType", 5125},
                             {"count", count},
                             {"type", "SCALAR"}});
    const std::size_t mesh =
        append("meshes", {{"name", name}, {"primitives", Json::array({std::move(primitive)})}});
    const std::size_t node = append("nodes", {{"name", name}, {"mesh", mesh}});
    root_["scene"] = 0;
    root_["scenes"][0]["nodes"].push_back(node);
  }

  Json root_ = {{"asset", {{"version", "2.0"}, {"generator", "portalens"}}}};
  std::string bytes_;
};

Solid segments(const std::vector<PathLine>& lines) {
  Solid solid;
  for (const PathLine& line : lines) {
    std::vector<Vec3d> points = line.points;
    if (line.tail != Vec3d{} && !points.empty()) points.push_back(points.back() + line.tail);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (i > 0) {
        const auto here = static_cast<std::uint32_t>(solid.positions.size());
        solid.indices.insert(solid.indices.end(), {here - 1, here});
      }
      solid.positions.push_back(floats(points[i]));
      solid.colors.push_back(floats(line.colors[std::min(i, line.colors.size() - 1)]));
    }
  }
  return solid;
}

Solid triangles(const FlatBody& body) {
  Solid solid;
  for (const Vec3d& vertex : body.vertices) solid.positions.push_back(floats(vertex));
  for (const auto& triangle : triangulate(body.vertices))
    for (const std::size_t corner : triangle)
      solid.indices.push_back(static_cast<std::uint32_t>(corner));
  return solid;
}

/// Rings of latitude with a point at each pole.
Solid globe(const RoundBody& body) {
  constexpr std::uint32_t columns = 24, rows = 12;
  Solid solid;
  const auto point = [&](double latitude, double longitude) {
    const double across = std::cos(latitude);
    solid.positions.push_back(
        floats(body.center + Vec3d{across * std::sin(longitude), std::sin(latitude),
                                   across * std::cos(longitude)} *
                                 body.radius));
  };
  constexpr double pi = std::numbers::pi;
  point(-pi / 2, 0.0);
  for (std::uint32_t row = 1; row < rows; ++row)
    for (std::uint32_t column = 0; column < columns; ++column)
      point(pi * row / rows - pi / 2, 2 * pi * column / columns);
  point(pi / 2, 0.0);
  const auto last = static_cast<std::uint32_t>(solid.positions.size() - 1);
  const auto at = [&](std::uint32_t row, std::uint32_t column) {
    return row == 0 ? 0 : row == rows ? last : 1 + (row - 1) * columns + column % columns;
  };
  for (std::uint32_t row = 0; row < rows; ++row)
    for (std::uint32_t column = 0; column < columns; ++column) {
      const std::uint32_t a = at(row, column), b = at(row, column + 1), c = at(row + 1, column + 1),
                          d = at(row + 1, column);
      if (a != b) solid.indices.insert(solid.indices.end(), {a, b, c});
      if (c != d) solid.indices.insert(solid.indices.end(), {a, c, d});
    }
  return solid;
}

}  // namespace

std::string paths_as_gltf(const PathPicture& picture) {
  Document document;
  const Solid lines = segments(picture.lines);
  if (!lines.indices.empty()) document.add_lines("photons", lines);
  for (const FlatBody& body : picture.flats)
    if (body.vertices.size() >= 3)
      document.add_triangles(body.name, triangles(body), body.color, 0.5);
  for (const RoundBody& body : picture.balls)
    document.add_triangles(body.name, globe(body), body.color, 1.0);
  return std::move(document).text();
}

}  // namespace portalens
