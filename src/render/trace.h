/// \file
/// One photon from its start to its fate, with mirrors on the path if asked, and its path written
/// down.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lanes/engine.h"
#include "render/layers.h"
#include "world/world.h"

namespace portalens {

/// What only a camera's photon has to tell.
struct PixelView {
  FirstHit first_hit;  ///< of its first surface: the values of the layers
  std::vector<Rgb>
      contributions;  ///< light that reaches the film from each bounce, and from the end
};

struct Trace {
  Photon start;
  /// The mirrors on the path. Lengths, turnings and steps, here and at the end, count from the
  /// start.
  std::vector<Arrival> bounces;
  Arrival end;
  PathTrace path_trace;
  std::optional<PixelView> view;
};

/// Follows a photon to its end. The first `max_bounces` surfaces are taken for exact mirrors,
/// whatever their material; masses, portals and the end are as always.
[[nodiscard]] Trace trace_ray(const World& world, const Photon& start, int max_bounces);

/// Follows a camera's photon as `render` does, from bounce to bounce as the materials mirror it,
/// with the same directions and the same light.
/// @param max_bounces  stops earlier than `shading.max_bounces` if it is less
[[nodiscard]] Trace trace_pixel(const World& world, const Photon& start, int max_bounces);

/// What the arrival met, as the scene names it; empty if nothing.
[[nodiscard]] std::string name_of_met(const World& world, const Arrival& arrival);

}  // namespace portalens
