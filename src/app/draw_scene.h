/// \file
/// A scene and photons' paths as one drawing.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/asked_rays.h"
#include "app/drawing.h"
#include "app/path_marks.h"
#include "app/standpoint.h"
#include "world/world.h"

namespace portalens {

struct DrawingSize {
  int width = 960;
  int height = 0;  ///< of the view, without the legend; 0: as the scene's film is shaped
};

struct DrawingStyle {
  DrawingSize size;
  int steps_a_color = 1;  ///< >= 1; in turn green and grey, if `color` is not given
  bool legend = true;
  std::optional<PathColor> color = {};  ///< what else a path's colour tells
};

/// Follows the photons on that many threads.
/// @throws SceneError if they take more steps than a drawing can show
[[nodiscard]] std::vector<DrawnPath> follow(const World& world, const std::vector<NamedRay>& rays,
                                            int bounces, int threads);

/// @throws SceneError as drawing_camera does
[[nodiscard]] Drawing draw_scene(const World& world, const std::vector<DrawnPath>& paths,
                                 const StandpointChoice& from, const DrawingStyle& style);

}  // namespace portalens
