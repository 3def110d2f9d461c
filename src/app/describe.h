/// \file
/// What a world holds, for `portalens check`.
#pragma once

#include <string>
#include <vector>

#include "app/json.h"
#include "scene/scene.h"
#include "world/world.h"

namespace portalens {

/// Everything: camera, film, physics, objects, masses with their radii, portals with their pairs,
/// lights, warnings and notes.
[[nodiscard]] Json describe_json(const Scene& scene, const World& world);

/// The same for people. Long lists are cut.
[[nodiscard]] std::string describe_text(const Scene& scene, const World& world);

}  // namespace portalens
