/// \file
/// What stands in a scene, drawn: surfaces, influences, portals, horizons, the camera.
#pragma once

#include <cstdint>

#include "app/sheet.h"
#include "photon/photon.h"
#include "world/world.h"

namespace portalens {

/// Surfaces, influences, portals and horizons, in this order.
void add_scene(const World& world, Sheet& sheet);

/// The scene's camera, for views from elsewhere.
/// @param size  of the little pyramid, length
void add_camera(const World& world, double size, Sheet& sheet);

}  // namespace portalens
