/// \file
/// A key of two lengths: the sides of a rectangle, the radii of an ellipse.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "core/parameters.h"

namespace portalens {

/// Whether one number stands for both.
enum class OneNumber { stands_for_both, is_not_enough };

/// Two lengths above 0, or nothing after a fault. The key is required.
[[nodiscard]] std::optional<std::array<double, 2>> two_lengths(Parameters& parameters,
                                                               std::string_view key,
                                                               OneNumber alone, const char* remedy);

}  // namespace portalens
