/// \file
/// A scene as plain numbers that can be drawn at random, thinned out, and written as a scene file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "math/vec3.h"

namespace portalens::differential {

/// What a thing weighs, if it does.
struct DraftWeight {
  double mass = 0.0;
  double core = 0.0;     ///< 0: none
  bool horizon = false;  ///< one beside a core; without a core there always is one
};

struct DraftMass {
  Vec3d center;
  DraftWeight weight;
};

enum class Form : std::uint8_t { sphere, quad, cube, mesh };

/// A surface. A sphere has `center` and `size`, its radius; a quad `corners`; a cube `center`,
/// `size` and `turn`; a mesh the same, and is an octahedron.
struct DraftBody {
  Form form = Form::sphere;
  Vec3d center, turn;
  double size = 0.0;
  std::vector<Vec3d> corners;
  bool mirror = false;
  DraftWeight weight;
};

struct DraftPortal {
  std::vector<Vec3d> corners;
  DraftWeight weight;
  bool solid_back = false;
  bool round = false;  ///< an ellipse; the corners are those of the rectangle about it
};

struct DraftCamera {
  Vec3d position, target, up{0, 1, 0};
  double fov = 40.0;
};

/// Members of a pair of portals stand beside each other: 2k and 2k + 1.
struct Draft {
  std::string kind;
  DraftCamera camera;
  std::vector<DraftMass> masses;
  std::vector<DraftBody> bodies;
  std::vector<DraftPortal> portals;
  std::string coupling = "closest-point";
  int depth = 1;
  int resolution = 32;
  double min_force = 1.0;
  double tolerance = 1e-4;
  double max_length = 1e6;
  int width = 48, height = 32;
};

/// The file that a draft with a mesh names, and what stands in it.
inline constexpr const char* mesh_name = "octahedron.obj";
[[nodiscard]] std::string mesh_text();
[[nodiscard]] bool has_mesh(const Draft& draft);

/// The scene file, headed by a line of comment.
[[nodiscard]] std::string to_toml(const Draft& draft, const std::string& comment);

}  // namespace portalens::differential
