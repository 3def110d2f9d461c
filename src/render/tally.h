/// \file
/// What was done for a picture, in numbers.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "photon/photon.h"

namespace portalens {

struct Tally {
  std::uint64_t samples = 0;         ///< photons that began at the camera
  std::uint64_t photons = 0;         ///< those, and their secondary photons
  std::uint64_t shadow_queries = 0;  ///< straight paths to lights
  std::uint64_t interpolated =
      0;  ///< photons that found what their neighbours told (sampling_grid.h)
  /// Neighbours that were sent for it. Tiles that a thread takes one after the other share some.
  std::uint64_t probe_rays = 0;
  std::uint64_t steps = 0;        ///< of all photons
  std::uint64_t handed_over = 0;  ///< of these, those that the scalar engine took for the lanes
  std::uint64_t crossings = 0;    ///< of portals, by all photons
  std::uint64_t out_of_crossings = 0;  ///< photons lost for want of more; the rest otherwise
  std::uint64_t not_finite = 0;        ///< samples whose light was not a number; shown as lost
  std::array<std::uint64_t, fate_count> fates{};  ///< of all photons, in the order of `Fate`

  /// Seconds of all threads together: photons on their paths (field, surfaces, portals), shading,
  /// and shadow queries.
  double advancing = 0.0, shading = 0.0, shadowing = 0.0;

  /// @return how many are lost
  std::uint64_t count(std::span<const Arrival> arrivals) {
    std::array<std::uint64_t, fate_count> ended{};
    std::uint64_t steps_taken = 0, steps_handed = 0, portals_crossed = 0, out = 0;
    for (const Arrival& arrival : arrivals) {
      steps_taken += arrival.steps;
      steps_handed += arrival.handed_over;
      portals_crossed += arrival.crossings;
      out += arrival.out_of_crossings ? 1 : 0;
      ++ended[static_cast<std::size_t>(arrival.fate)];
    }
    photons += arrivals.size();
    steps += steps_taken;
    handed_over += steps_handed;
    crossings += portals_crossed;
    out_of_crossings += out;
    for (std::size_t i = 0; i < fates.size(); ++i) fates[i] += ended[i];
    return ended[static_cast<std::size_t>(Fate::lost)];
  }
  Tally& operator+=(const Tally& other) {
    samples += other.samples;
    photons += other.photons;
    shadow_queries += other.shadow_queries;
    interpolated += other.interpolated;
    probe_rays += other.probe_rays;
    steps += other.steps;
    handed_over += other.handed_over;
    crossings += other.crossings;
    out_of_crossings += other.out_of_crossings;
    not_finite += other.not_finite;
    advancing += other.advancing;
    shading += other.shading;
    shadowing += other.shadowing;
    for (std::size_t i = 0; i < fates.size(); ++i) fates[i] += other.fates[i];
    return *this;
  }
};

}  // namespace portalens
