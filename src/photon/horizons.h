/// \file
/// Where light ends about masses, met at rest and on a curve: on the horizon of one, or, under a
/// law that has a `greatest_potential`, where w comes to that.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "photon/curve.h"
#include "photon/space.h"

namespace portalens {

struct HorizonContact {
  std::uint32_t mass;
  double distance;  ///< arc length on the curve
};

/// The mass that absorbs what is at `x`: the first within whose horizon that lies, or the one that
/// counts for most there.
/// @param near  those to ask, ascending
[[nodiscard]] std::optional<std::uint32_t> horizon_around(const Space& space,
                                                          std::span<const std::uint32_t> near,
                                                          Vec3d x);

/// The first place where the curve ends on a mass: sought at its end and at its closest approach.
/// @param near  the masses to ask, ascending
[[nodiscard]] std::optional<HorizonContact> first_horizon(const Space& space,
                                                          std::span<const std::uint32_t> near,
                                                          const Curve& curve);

}  // namespace portalens
