/// \file
/// Paths of photons out, for other programs: OBJ, PLY, glTF and CSV.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/error.h"
#include "math/vec3.h"

namespace portalens {

/// One stretch of a photon's path, between portals.
struct PathLine {
  std::size_t photon = 0, stretch = 0;  ///< counted from 0
  std::vector<Vec3d> points;
  std::vector<Rgb> colors;  ///< linear, 0 to 1, one a point
  Vec3d tail;               ///< where it goes on straight from its last point; 0 if it does not
};

/// A flat body: a simple polygon.
struct FlatBody {
  std::string name;
  std::vector<Vec3d> vertices;  ///< counter-clockwise seen from the front
  Rgb color;
};

/// A ball.
struct RoundBody {
  std::string name;
  Vec3d center;
  double radius = 0.0;
  Rgb color;
};

/// Paths, and the bodies that explain them.
struct PathPicture {
  std::vector<PathLine> lines;
  std::vector<FlatBody> flats;
  std::vector<RoundBody> balls;
};

/// Each point of each line, with 17 digits: photon, stretch, index, x, y, z. No tails.
[[nodiscard]] std::string paths_as_csv(const PathPicture& picture);
/// A group and an `l` a line, tails included.
[[nodiscard]] std::string paths_as_obj(const PathPicture& picture);
/// Text; vertices with colours, edges between neighbours; tails included.
[[nodiscard]] std::string paths_as_ply(const PathPicture& picture);
/// glTF 2.0 with its buffer inside: a mesh of coloured lines, and one for each body.
[[nodiscard]] std::string paths_as_gltf(const PathPicture& picture);
/// Whether the suffix is one of .obj, .ply, .gltf, .csv.
[[nodiscard]] bool is_path_file(const std::filesystem::path& file);

/// Writes as the suffix says. The old file stays whole until the new one is.
/// @pre is_path_file
/// @throws WorkError with the path and the cause
void write_paths(const std::filesystem::path& file, const PathPicture& picture);

}  // namespace portalens
