/// \file
/// The photons that a drawing is asked to show.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/ray.h"
#include "world/world.h"

namespace portalens {

/// As the command line gave them: flat lists of numbers.
struct AskedRays {
  std::vector<double> rays;  ///< six each
  std::string file;          ///< lines of six; "-": standard input; empty: none
  std::vector<int> pixels;   ///< two each
  std::vector<double> fan;   ///< none, or origin, direction, spread in degrees, count
  std::vector<int> grid;     ///< none, or columns and rows
};

struct NamedRay {
  std::string name;
  Ray ray;
};

/// All of them, in the order of the members above.
/// @param across  what a fan is spread at right angles to, if its direction allows
/// @throws SceneError that names every one that is no ray, or if there are more than 10,000
[[nodiscard]] std::vector<NamedRay> rays_of(const World& world, const AskedRays& asked,
                                            Vec3d across);

}  // namespace portalens
