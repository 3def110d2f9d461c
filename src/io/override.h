/// \file
/// Values of a scene that the command line sets.
#pragma once

#include <string>

#include "scene/scene.h"

namespace portalens {

/// Sets `section.key` ("physics.tolerance=1e-5") or `kind.name.key` ("sphere.ball.radius=2",
/// "material.floor.diffuse=[1, 0, 0]") to a value written as in TOML, as if the file said so. The
/// name of a table without one is its kind and its index among those of its kind (`sphere0`), which
/// may also be written alone (`sphere.0.radius=2`). A section, kind or name that the scene lacks is
/// a fault.
/// @param set_at  where the assignment stands, for that fault and for any that the value makes
/// later
void override_value(Scene& scene, const std::string& assignment, Faults& faults,
                    const Location& set_at = {});

}  // namespace portalens
