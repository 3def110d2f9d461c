/// \file
/// What a picture's header tells of the view.
#pragma once

#include "io/exr_matrix.h"
#include "io/image.h"
#include "world/world.h"

namespace portalens {

/// Where the picture is seen from, how far it reaches, and what lies behind all.
[[nodiscard]] Metadata view_metadata(const World& world);

/// From the world to the camera's coordinates.
[[nodiscard]] ExrMatrix world_to_camera(const Camera& camera);

}  // namespace portalens
