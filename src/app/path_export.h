/// \file
/// From traced photons to a picture of their paths that other programs open.
#pragma once

#include <map>
#include <string>

#include "app/trace_ray.h"
#include "io/polylines.h"
#include "world/world.h"

namespace portalens {

/// What the colour of a path tells: how the photon ended, or how sharply it turns there.
enum class PathColor { fate, turning };

/// As the command line names them.
[[nodiscard]] inline std::map<std::string, PathColor> path_color_names() {
  return {{"fate", PathColor::fate}, {"turning", PathColor::turning}};
}

/// Linear: from blue over grey to red.
/// @param share  0: straight, 1: where it turns most
[[nodiscard]] Rgb turning_color(double share);

/// Collects paths. Colours by turning are chosen when all are known: blue where a path is straight,
/// over grey to red where it turns most (on a logarithmic scale, over three powers of ten).
class PathExport {
 public:
  PathExport(const World& world, PathColor color) : world_(world), color_(color) {}

  /// Adds the next photon. One that escapes goes on straight for a while.
  void add(const Trace& trace);

  /// The paths, the portals (each pair in two colours), and the masses: balls of the size of their
  /// horizon, or of their core.
  [[nodiscard]] PathPicture release() &&;

 private:
  void color_by_turning();

  const World& world_;
  PathColor color_;
  std::size_t photons_ = 0;
  PathPicture picture_;
};

}  // namespace portalens
