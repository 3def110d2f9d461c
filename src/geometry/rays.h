/// \file
/// Rays from what a user gives: one from six numbers, or a fan of them.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "geometry/ray.h"

namespace portalens {

/// A ray with its direction made a unit vector.
/// @param numbers  x y z of the origin, then of the direction
/// @return nothing if a number is not finite, or the direction is zero
[[nodiscard]] std::optional<Ray> ray_of(const std::array<double, 6>& numbers);

/// Rays of one origin that are spread evenly about a middle one, in one plane.
/// @param across  what the plane is at right angles to, as nearly as the middle ray allows
/// @param spread  degrees between the first and the last
/// @param count   >= 1; a single ray is the middle one
[[nodiscard]] std::vector<Ray> fan_of(const Ray& middle, Vec3d across, double spread, int count);

}  // namespace portalens
