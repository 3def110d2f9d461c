/// \file
/// Values of a scene that the command line sets.
#pragma once

#include <string>

#include "scene/scene.h"

namespace portalens {

/// Sets `section.key` ("physics.tolerance=1e-5") or `kind.name.key` ("sphere.ball.radius=2",
/// "material.floor.diffuse=[1, 0, 0]") to a value written as in TOML, as if the file said so. The
/// name of a table without one is its kind and its index among those of its kind (`sphere0`). A
/// section, kind or name that the scene lacks is a fault of the command line.
void override_value(Scene& scene, const std::string& assignment, Faults& faults);

}  // namespace portalens
