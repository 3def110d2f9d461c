#include "io/polylines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>

#include "io/files.h"
#include "math/srgb.h"

namespace portalens {
namespace {

namespace fs = std::filesystem;

/// A line's points, and the end of its tail if it has one.
template <class Take>
void each_point(const PathLine& line, const Take& take) {
  for (std::size_t i = 0; i < line.points.size(); ++i) take(line.points[i], line.colors[i]);
  if (line.tail != Vec3d{} && !line.points.empty())
    take(line.points.back() + line.tail, line.colors.back());
}

std::size_t point_count(const PathLine& line) {
  return line.points.size() + (line.tail != Vec3d{} && !line.points.empty() ? 1 : 0);
}

int byte_of(double linear) {
  return static_cast<int>(std::lround(255.0 * srgb_from_linear(std::clamp(linear, 0.0, 1.0))));
}

using Encoder = std::string (*)(const PathPicture&);

/// By the suffix; none if it is another.
Encoder encoder_of(const fs::path& file) {
  std::string suffix = file.extension().string();
  for (char& letter : suffix)
    letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  if (suffix == ".csv") return paths_as_csv;
  if (suffix == ".obj") return paths_as_obj;
  if (suffix == ".ply") return paths_as_ply;
  return suffix == ".gltf" ? paths_as_gltf : nullptr;
}

}  // namespace

std::string paths_as_csv(const PathPicture& picture) {
  std::string text = "photon,stretch,index,x,y,z\n";
  const auto out = std::back_inserter(text);
  for (const PathLine& line : picture.lines)
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      const Vec3d& point = line.points[i];
      fmt::format_to(out, "{},{},{},{:.17g},{:.17g},{:.17g}\n", line.photon, line.stretch, i,
                     point.x, point.y, point.z);
    }
  return text;
}

std::string paths_as_obj(const PathPicture& picture) {
  std::string text = "# paths of photons, by portalens\n";
  const auto out = std::back_inserter(text);
  std::size_t next = 1;
  for (const PathLine& line : picture.lines) {
    if (point_count(line) < 2) continue;
    fmt::format_to(out, "o photon_{}_stretch_{}\n", line.photon, line.stretch);
    each_point(line, [&](Vec3d x, Rgb) {
      fmt::format_to(out, "v {:.17g} {:.17g} {:.17g}\n", x.x, x.y, x.z);
    });
    text += 'l';
    for (std::size_t i = 0; i < point_count(line); ++i) fmt::format_to(out, " {}", next++);
    text += '\n';
  }
  return text;
}

std::string paths_as_ply(const PathPicture& picture) {
  std::size_t vertices = 0, edges = 0;
  for (const PathLine& line : picture.lines) {
    vertices += point_count(line);
    edges += point_count(line) > 0 ? point_count(line) - 1 : 0;
  }
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\ncomment paths of photons, by portalens\nelement vertex {}\n"
      "property double x\nproperty double y\nproperty double z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
      "element edge {}\nproperty int vertex1\nproperty int vertex2\nend_header\n",
      vertices, edges);
  const auto out = std::back_inserter(text);
  for (const PathLine& line : picture.lines)
    each_point(line, [&](Vec3d x, Rgb c) {
      fmt::format_to(out, "{:.17g} {:.17g} {:.17g} {} {} {}\n", x.x, x.y, x.z, byte_of(c.x),
                     byte_of(c.y), byte_of(c.z));
    });
  std::size_t first = 0;
  for (const PathLine& line : picture.lines) {
    for (std::size_t i = 1; i < point_count(line); ++i)
      fmt::format_to(out, "{} {}\n", first + i - 1, first + i);
    first += point_count(line);
  }
  return text;
}

bool is_path_file(const fs::path& file) { return encoder_of(file) != nullptr; }

void write_paths(const fs::path& file, const PathPicture& picture) {
  replace_file(file, encoder_of(file)(picture));
}

}  // namespace portalens
