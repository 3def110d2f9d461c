/// \file
/// The one loop that carries light round: photons are advanced until each has arrived, arrivals are
/// shaded, and what that gives (light, shadow queries, secondary photons) goes on, until none is
/// left.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "photon/photon.h"
#include "photon/space.h"
#include "render/tally.h"
#include "shading/occlusion_pretest.h"
#include "shading/shade.h"

namespace portalens {

/// Seconds of wall time between two looks.
class Stopwatch {
 public:
  double lap() {
    const auto now = Clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

inline constexpr double max_presentable = std::numeric_limits<float>::max();

/// What a picture can hold of a sample's light: a channel beyond the largest float becomes that,
/// and light that is not a number, which would spoil its pixel unseen, is shown as lost.
[[nodiscard]] inline Rgb presentable(Rgb light, Rgb lost_color) {
  constexpr double most = max_presentable;
  const Rgb sound = is_finite(light) ? light : lost_color;
  return {std::min(sound.x, most), std::min(sound.y, most), std::min(sound.z, most)};
}
/// Whether it stays as it is.
[[nodiscard]] inline bool is_presentable(Rgb light) {
  const double x = std::fabs(light.x), y = std::fabs(light.y), z = std::fabs(light.z);
  constexpr double most = max_presentable;
  return x + y + z <= most || (x <= most && y <= most && z <= most);
}

/// The room that carrying light takes. Whoever carries often keeps it: fresh memory costs more than
/// what is done in it.
struct WaveRoom {
  std::vector<Photon> secondary, parents;
  std::vector<Arrival> arrivals;
  ShadeOutput found;
  OcclusionPretest near;  ///< of what may cast shadows there
};

/// Adds to `light[photon.sample]` what each of the first photons and their secondary photons find.
/// A sample's light is added in order of wave, and within one first what its photon saw, then its
/// shadow queries in their order; so its sum does not depend on which other photons travel along.
/// In the end each light is made presentable; those that were not are counted.
/// @param room     what is in it does not matter
/// @param advance  takes photons to their arrivals: called as `advance(photons, arrivals)`
/// @param lost     if given, gets the sample of each photon that is lost, and of light not a number
/// @pre every photon's sample < light.size(), and no two photons have the same
template <class Advance>
void carry_light(const Space& space, const Appearance& appearance, std::span<const Photon> first,
                 WaveRoom& room, std::span<Rgb> light, const Advance& advance, Tally& tally,
                 std::vector<std::uint32_t>* lost = nullptr) {
  // So few that what shading gives stays in the nearest cache until it is used.
  constexpr std::size_t max_photons = 256, max_queries = std::size_t{1} << 16;
  // So few shadow queries that their paths mostly lie close together.
  constexpr std::size_t max_neighbours = 32;
  const std::size_t each = std::max<std::size_t>(1, max_shadow_queries(space, appearance));
  const std::size_t slice = std::max<std::size_t>(1, std::min(max_photons, max_queries / each));

  const OcclusionPretest screen(space);
  auto& [secondary, parents, arrivals, found, near] = room;
  std::span<const Photon> wave = first;
  tally.samples += wave.size();
  while (!wave.empty()) {
    arrivals.resize(wave.size());
    Stopwatch watch;
    advance(wave, std::span<Arrival>(arrivals));
    tally.advancing += watch.lap();
    secondary.clear();
    for (std::size_t begin = 0; begin < wave.size(); begin += slice) {
      const std::size_t count = std::min(slice, wave.size() - begin);
      const auto photons = wave.subspan(begin, count);
      const auto arrived = std::span<const Arrival>(arrivals).subspan(begin, count);
      if (tally.count(arrived) > 0 && lost)
        for (std::size_t i = 0; i < count; ++i)
          if (arrived[i].fate == Fate::lost) lost->push_back(photons[i].sample);
      found.light.clear();
      found.secondary.clear();
      found.shadows.clear();
      shade(space, appearance, photons, arrived, found);
      tally.shading += watch.lap();
      for (const Contribution& contribution : found.light)
        light[contribution.sample] += contribution.radiance;
      for (std::span<const ShadowQuery> left = found.shadows; !left.empty();) {
        const auto neighbours = left.first(std::min(max_neighbours, left.size()));
        left = left.subspan(neighbours.size());
        near.narrow(screen, neighbours);
        for (const ShadowQuery& query : neighbours)
          if (near.surely_free(query) || visible(space, query))
            light[query.sample] += query.contribution;
      }
      tally.shadow_queries += found.shadows.size();
      secondary.insert(secondary.end(), found.secondary.begin(), found.secondary.end());
      tally.shadowing += watch.lap();
    }
    std::swap(parents, secondary);
    wave = parents;
  }
  for (std::size_t i = 0; i < light.size(); ++i) {
    if (is_presentable(light[i])) continue;
    if (!is_finite(light[i])) {
      ++tally.not_finite;
      if (lost) lost->push_back(static_cast<std::uint32_t>(i));
    }
    light[i] = presentable(light[i], appearance.limits.lost_color);
  }
}

}  // namespace portalens
