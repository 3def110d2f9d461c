/// \file
/// How large and how small a shape may be, so that no square of a length overflows or vanishes.
#pragma once

#include <string_view>

#include "core/parameters.h"
#include "geometry/ray.h"

namespace portalens {

inline constexpr double largest_coordinate = 1e12;
inline constexpr double smallest_length = 1e-9;
/// What a coordinate must satisfy.
inline constexpr Bounds coordinate{-largest_coordinate, largest_coordinate, false};

/// Adds a fault at `key` if the box leaves ±1e12, or if `least`, the shape's smallest length, is
/// below 1e-9 or lost in the rounding of its place.
[[nodiscard]] bool extent_allowed(Parameters& parameters, std::string_view key, const Box& box,
                                  double least);

}  // namespace portalens
