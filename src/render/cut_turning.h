/// \file
/// What the end of influences takes from the bending of light. equations.md, section 2.
#pragma once

#include <cstddef>
#include <optional>

#include "render/trace.h"
#include "world/world.h"

namespace portalens {

/// Of scenes with more masses it is not told.
inline constexpr std::size_t max_cut_masses = 256;

/// By how much, about, a photon would turn besides if no pull ended at its radius of influence
/// (`min_force` 0), radians: the pull of each mass where the path lies beyond its influence, along
/// the path as it is, to infinity if the photon escaped. Masses pull directly; what portals would
/// bring is left out. Nothing for too many masses.
[[nodiscard]] std::optional<double> cut_turning(const World& world, const Trace& trace);

}  // namespace portalens
