/// \file
/// A scene set up twice, at its own tolerance and at that of the reference, with its photons.
#pragma once

#include <filesystem>
#include <vector>

#include "differential/draft.h"
#include "lanes/engine.h"
#include "support/scene_folder.h"
#include "world/world.h"

namespace portalens::differential {

/// What the scalar engine must keep to so that others can be held to it.
[[nodiscard]] double reference_tolerance(double tolerance);

struct Stage {
  World own;    ///< as the scene says
  World exact;  ///< at the reference's tolerance, with more steps allowed
  /// One through the middle of each pixel; in rooms, after those, such as leave what these have met
  /// as a mirror would send them.
  std::vector<Photon> photons;
};

/// Read and compiled as the program does, with the camera's photons.
/// @throws SceneError if the scene is refused
[[nodiscard]] Stage set_up(const std::filesystem::path& file);

/// The same of a draft, and for rooms the mirrored photons.
/// @param folder  where its files are written; what stood there is written over
/// @throws SceneError if the scene is refused
[[nodiscard]] Stage set_up(const Draft& draft, const SceneFolder& folder);

}  // namespace portalens::differential
