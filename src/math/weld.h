/// \file
/// Vertices that a file lists more than once.
#pragma once

#include <cstdint>
#include <vector>

#include "math/vec3.h"

namespace portalens {

/// For each position, the first one equal to it.
[[nodiscard]] std::vector<std::uint32_t> welded(const std::vector<Vec3d>& positions);

}  // namespace portalens
