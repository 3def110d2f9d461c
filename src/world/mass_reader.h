/// \file
/// The keys by which any primitive may carry a mass.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/parameters.h"
#include "gravity/mass.h"
#include "photon/physics.h"

namespace portalens {

enum class MassKey { required, optional };

/// Reads `mass`, `core_radius` and `horizon`, and `center_of_mass` where the mass is optional.
/// Appends to `masses` what has a mass above 0, and returns its index.
/// @param center  of mass, unless the table gives another
std::optional<std::uint32_t> read_mass(Parameters& parameters, const std::string& name, MassKey key,
                                       Vec3d center, const Physics& physics,
                                       std::vector<Mass>& masses);

}  // namespace portalens
