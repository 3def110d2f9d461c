/// \file
/// Turning arrivals into light. Shading never traces: what it wants to know of the rest of the
/// scene it asks as new photons and shadow queries, which the caller carries round.
#pragma once

#include <span>
#include <vector>

#include "photon/photon.h"
#include "photon/space.h"
#include "shading/appearance.h"
#include "shading/shadow.h"

namespace portalens {

/// Light that has arrived at a sample of the film.
struct Contribution {
  Rgb radiance;
  std::uint32_t sample = 0, slot = 0;  ///< of the photon that found it
};

/// All three in the order of the photons they come from; a photon has at most one contribution and
/// at most one secondary photon, whose slot is its parent's.
struct ShadeOutput {
  std::vector<Contribution> light;
  std::vector<Photon> secondary;
  std::vector<ShadowQuery> shadows;
};

/// Appends to `output` what the arrivals give. `arrivals[i]` is where `photons[i]` ended. Nothing
/// that is black is put out. What a photon gives does not depend on the others.
/// @pre photons.size() == arrivals.size()
void shade(const Space& space, const Appearance& appearance, std::span<const Photon> photons,
           std::span<const Arrival> arrivals, ShadeOutput& output);

/// Whether what photons give depends on their random keys: some light has an area, or some surface
/// mirrors.
[[nodiscard]] bool uses_random_numbers(const Appearance& appearance);

/// The most shadow queries that one arrival can lead to, by which a caller can bound its batches.
[[nodiscard]] std::size_t max_shadow_queries(const Space& space, const Appearance& appearance);

}  // namespace portalens
