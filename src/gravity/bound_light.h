/// \file
/// Where light that feels a mass through a portal comes so near to it that it is bound: a horizon
/// stops light that meets it, but none that only feels its mass from afar.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "gravity/mass.h"
#include "portal/portal.h"

namespace portalens {

/// A mass, and the portal through which it is felt.
struct BoundLight {
  std::uint32_t mass, portal;
  double distance;  ///< from where it is felt at the nearest, its core counted; 0: without a bound
};

/// From where a mass is felt at the nearest by light that feels it through the pair of `exit`: its
/// distance from the polygon `exit`, with its core as if that lay across.
[[nodiscard]] double felt_from(const Portal& exit, const Mass& mass);

/// Whether light that feels a mass from there winds ever closer to it: nearer than the law's
/// `light_sphere` (m = G M / c² under the paper's). Around a point n r sin(angle) is least there.
/// @param light_sphere  in m
[[nodiscard]] inline bool binds(const Mass& mass, double distance, double c, double light_sphere) {
  return mass.gm > 0.0 && distance < light_sphere * gravitational_radius(mass.gm, c);
}

/// The masses that bind light through a portal, with a coupling that lets each mass act through
/// each (`closest-point`, `graviton-map`, `shortest-path`); none with others. By mass, then portal.
[[nodiscard]] std::vector<BoundLight> bound_light(std::string_view coupling,
                                                  std::span<const Portal> portals,
                                                  std::span<const Mass> masses, double c,
                                                  double light_sphere);

}  // namespace portalens
