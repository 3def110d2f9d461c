/// \file
/// The rays that `portalens trace` is asked for: one a line, `x y z dx dy dz`.
#pragma once

#include <array>
#include <istream>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "geometry/ray.h"

namespace portalens {

/// A ray with its direction made a unit vector.
/// @return nothing if a number is not finite, or the direction is zero
[[nodiscard]] std::optional<Ray> ray_of(const std::array<double, 6>& numbers);

/// Empty lines, and those that begin with '#', are skipped.
/// @param name  what messages call the input
/// @throws SceneError that names every malformed line
[[nodiscard]] std::vector<Ray> read_rays(std::istream& input, const std::string& name);

}  // namespace portalens
