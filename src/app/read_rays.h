/// \file
/// The rays that `portalens trace` is asked for: one a line, `x y z dx dy dz`.
#pragma once

#include <istream>
#include <string>
#include <vector>

#include "core/error.h"
#include "geometry/ray.h"

namespace portalens {

/// Empty lines, and those that begin with '#', are skipped.
/// @param name  what messages call the input
/// @throws SceneError that names every malformed line
[[nodiscard]] std::vector<Ray> read_rays(std::istream& input, const std::string& name);

/// The rays of --ray.
/// @param numbers  six a ray; anything else is a fault
[[nodiscard]] std::vector<Ray> rays_in(const std::vector<double>& numbers, Faults& faults);

}  // namespace portalens
