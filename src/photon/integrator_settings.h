/// \file
/// What an integrator is made from.
#pragma once

#include <string_view>

namespace portalens {

struct IntegratorSettings {
  double step = 0.02;       ///< arc length of a fixed step
  double tolerance = 1e-4;  ///< error in direction over a path, radians
};

}  // namespace portalens
