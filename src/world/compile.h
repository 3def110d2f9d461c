/// \file
/// The one place where a `Scene` gets its meaning.
#pragma once

#include "io/paths.h"
#include "scene/scene.h"
#include "world/world.h"

namespace portalens {

struct CompileOptions {
  Containment files = Containment::scene_folder;  ///< where textures and meshes may lie
};

/// @throws SceneError with all the faults of the scene
[[nodiscard]] World compile(const Scene& scene, const CompileOptions& options = {});

}  // namespace portalens
