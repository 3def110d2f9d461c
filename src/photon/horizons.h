/// \file
/// The horizons of masses, met at rest and on a curve.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "gravity/mass.h"
#include "photon/curve.h"

namespace portalens {

struct HorizonContact {
  std::uint32_t mass;
  double distance;  ///< arc length on the curve
};

/// The first mass within whose horizon `x` lies.
/// @param near  those to ask, ascending
[[nodiscard]] inline std::optional<std::uint32_t> horizon_around(
    std::span<const Mass> masses, std::span<const std::uint32_t> near, Vec3d x) {
  for (const std::uint32_t i : near) {
    const Vec3d d = masses[i].center - x;
    if (masses[i].has_horizon() && dot(d, d) <= masses[i].schwarzschild * masses[i].schwarzschild)
      return i;
  }
  return std::nullopt;
}

/// The first horizon that the curve meets: sought at its end and at its closest approach.
/// @param near  the masses to ask, ascending
[[nodiscard]] std::optional<HorizonContact> first_horizon(std::span<const Mass> masses,
                                                          std::span<const std::uint32_t> near,
                                                          const Curve& curve);

}  // namespace portalens
