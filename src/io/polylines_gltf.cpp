// Paths of photons as glTF 2.0 (Khronos Group; ISO/IEC 12113:2022): one file, its buffer inside as
// base64. Positions and colours are floats, colours linear, as the format has them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <numbers>
#include <string_view>

#include "io/polylines.h"

namespace portalens {
namespace {

using Triple = std::array<float, 3>;

Triple floats(Vec3d v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// A JSON string: control characters and quotes escaped, bytes beyond ASCII replaced.
std::string json_string(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      result += std::string("\\") + c;
    else if (byte < 0x20 || byte >= 0x7f)
      result += fmt::format("\\u{:04x}", byte < 0x20 ? byte : 0xfffd);
    else
      result += c;
  }
  return result + '"';
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
  std::vector<Triple> positions, colors;
  std::vector<std::uint32_t> indices;
};

/// Puts a document together, piece by piece.
class Document {
 public:
  void add_lines(const std::string& name, const Solid& solid) { add(name, solid, 1, ""); }

  void add_triangles(const std::string& name, const Solid& solid, Rgb color, double opacity) {
    materials_.push_back(fmt::format(
        R"({{"name":{},"doubleSided":true,"alphaMode":"{}","pbrMetallicRoughness":)"
        R"({{"baseColorFactor":[{},{},{},{}],"metallicFactor":0,"roughnessFactor":1}}}})",
        json_string(name), opacity < 1.0 ? "BLEND" : "OPAQUE", std::clamp(color.x, 0.0, 1.0),
        std::clamp(color.y, 0.0, 1.0), std::clamp(color.z, 0.0, 1.0), opacity));
    add(name, solid, 4, fmt::format(R"(,"material":{})", materials_.size() - 1));
  }

  [[nodiscard]] std::string text() const {
    std::string roots;
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      roots += (i == 0 ? "" : ",") + std::to_string(i);
    std::string json = R"({"asset":{"version":"2.0","generator":"portalens"})";
    if (nodes_.empty()) return json + "}\n";
    json += R"(,"scene":0,"scenes":[{"nodes":[)" + roots + "]}]";
    json += list("nodes", nodes_) + list("meshes", meshes_) + list("materials", materials_) +
            list("accessors", accessors_) + list("bufferViews", views_);
    return json + fmt::format(R"(,"buffers":[{{"byteLength":{},"uri":)"
                              R"("data:application/octet-stream;base64,{}"}}]}})"
                              "\n",
                              bytes_.size(), base64(bytes_));
  }

 private:
  static std::string list(const char* key, const std::vector<std::string>& items) {
    return items.empty() ? std::string{} : fmt::format(R"(,"{}":[{}])", key, fmt::join(items, ","));
  }

  /// Appends numbers of four bytes, little-endian; the index of their view.
  template <class Number>
  std::size_t view(const Number* numbers, std::size_t count, int target) {
    views_.push_back(fmt::format(R"({{"buffer":0,"byteOffset":{},"byteLength":{},"target":{}}})",
                                 bytes_.size(), 4 * count, target));
    for (std::size_t i = 0; i < count; ++i) {
      const auto bits = std::bit_cast<std::uint32_t>(numbers[i]);
      for (int shift = 0; shift < 32; shift += 8) bytes_ += static_cast<char>(bits >> shift & 0xff);
    }
    return views_.size() - 1;
  }

  std::size_t triples(const std::vector<Triple>& values, bool with_bounds) {
    std::string bounds;
    if (with_bounds) {
      Triple low = values.front(), high = values.front();
      for (const Triple& value : values)
        for (std::size_t c = 0; c < 3; ++c) {
          low[c] = std::min(low[c], value[c]);
          high[c] = std::max(high[c], value[c]);
        }
      // As doubles: their digits give back the very float.
      const std::vector<double> least(low.begin(), low.end()), most(high.begin(), high.end());
      bounds =
          fmt::format(R"(,"min":[{}],"max":[{}])", fmt::join(least, ","), fmt::join(most, ","));
    }
    const std::size_t at = view(values.front().data(), 3 * values.size(), 34962);
    accessors_.push_back(
        fmt::format(R"({{"bufferView":{},"componentType":5126,"count":{},"type":"VEC3"{}}})", at,
                    values.size(), bounds));
    return accessors_.size() - 1;
  }

  void add(const std::string& name, const Solid& solid, int mode, const std::string& more) {
    std::string attributes = fmt::format(R"("POSITION":{})", triples(solid.positions, true));
    if (!solid.colors.empty())
      attributes += fmt::format(R"(,"COLOR_0":{})", triples(solid.colors, false));
    const std::size_t at = view(solid.indices.data(), solid.indices.size(), 34963);
    accessors_.push_back(
        fmt::format(R"({{"bufferView":{},"componentType":5125,"count":{},"type":"SCALAR"}})", at,
                    solid.indices.size()));
    meshes_.push_back(fmt::format(
        R"({{"name":{},"primitives":[{{"attributes":{{{}}},"indices":{},"mode":{}{}}}]}})",
        json_string(name), attributes, accessors_.size() - 1, mode, more));
    nodes_.push_back(
        fmt::format(R"({{"name":{},"mesh":{}}})", json_string(name), meshes_.size() - 1));
  }

  std::vector<std::string> nodes_, meshes_, materials_, accessors_, views_;
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

Solid fan(const FlatBody& body) {
  Solid solid;
  for (const Vec3d& vertex : body.vertices) solid.positions.push_back(floats(vertex));
  for (std::uint32_t i = 2; i < body.vertices.size(); ++i)
    solid.indices.insert(solid.indices.end(), {0, i - 1, i});
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
    if (body.vertices.size() >= 3) document.add_triangles(body.name, fan(body), body.color, 0.5);
  for (const RoundBody& body : picture.balls)
    document.add_triangles(body.name, globe(body), body.color, 1.0);
  return document.text();
}

}  // namespace portalens
