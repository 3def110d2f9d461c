/// \file
/// From where a drawing is made.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/path_marks.h"
#include "world/world.h"

namespace portalens {

/// `camera`: the scene's own, or one that the user places. The others are plans, without
/// perspective.
enum class Standpoint { camera, top, front, side };

struct StandpointChoice {
  Standpoint from = Standpoint::camera;
  std::optional<Vec3d> eye;      ///< a camera elsewhere
  std::optional<Vec3d> look_at;  ///< with `eye`; by default the middle of what matters
  std::optional<double> fov;     ///< with `eye`, degrees across the height; by default all that
                                 ///< matters is seen
  /// Of a plan: the least and the largest of what its two axes show (top x z, front x y, side z y).
  std::optional<std::array<double, 4>> extent;
};

/// The box around what a drawing is about: paths, portals, masses, and the surfaces that are not
/// much larger. Never empty.
[[nodiscard]] Box box_of_interest(const World& world, const std::vector<DrawnPath>& paths);

/// @throws SceneError if the user's camera looks at itself
[[nodiscard]] Camera drawing_camera(const World& world, const StandpointChoice& choice,
                                    const Box& interest, double aspect);

/// In words, for the title.
[[nodiscard]] std::string standpoint_text(const StandpointChoice& choice);

}  // namespace portalens
