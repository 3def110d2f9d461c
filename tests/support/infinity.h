/// \file
/// A distance that nothing is beyond.
#pragma once

#include <limits>

namespace portalens::test {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace portalens::test
