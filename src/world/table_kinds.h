/// \file
/// Which tables a scene may have, and what is said of others.
#pragma once

#include "scene/scene.h"

namespace portalens {

/// Adds a fault for each thing that stands where a list of tables should, and for each kind of
/// object that there is none of: once a kind, at the first of them.
void refuse_unknown_tables(const Scene& scene, Faults& faults);

}  // namespace portalens
