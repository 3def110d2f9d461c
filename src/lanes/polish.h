/// \file
/// Hits that were found in float, in double.
#pragma once

#include <cmath>
#include <cstdint>
#include <variant>

#include "photon/space.h"

namespace portalens {

/// How far a hit that was found in float is from its surface in double, along its path; 0 if that
/// is more than a float's rounding explains.
/// @param length  of the path so far
[[nodiscard]] inline double distance_to_surface(const Space& space, std::uint32_t object,
                                                const Ray& ray, double length) {
  const double reach = 1e-3 * (1e-3 * space.extent + length);
  double distance = 2.0 * reach;
  if (const auto* quad = std::get_if<Quad>(&space.surfaces.shapes()[object]))
    distance = quad->distance_of_plane(ray);
  else if (const auto contact = space.surfaces.contact_near(object, 0, ray, reach))
    distance = contact->distance;
  return std::fabs(distance) <= reach ? distance : 0.0;
}

}  // namespace portalens
