/// \file
/// What must be true of whatever the readers make of a stranger's file.
#pragma once

#include <vector>

#include "core/error.h"
#include "core/image.h"
#include "io/read_mesh.h"
#include "scene/scene.h"

namespace portalens::fuzz {

/// Each says what is wrong and what would be right, in letters that a terminal may be given.
void check_faults(const std::vector<Fault>& faults);

/// Its tables have kinds, its faults are well told.
void check_scene(const Scene& scene);

/// Every corner is there, and every number finite.
void check_mesh(const MeshFile& mesh);

/// Three channels, all finite, and as many pixels as it says.
void check_image(const Image& image);

}  // namespace portalens::fuzz
