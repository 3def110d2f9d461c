/// \file
/// What enters `advance`, and what comes out of it.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "geometry/accelerator.h"
#include "math/vec3.h"

namespace portalens {

/// How a photon ends; equations.md, sec. 6.
enum class Fate : std::uint8_t { hit, absorbed, escaped, trapped, lost };
inline constexpr int fate_count = 5;
inline constexpr std::array<std::string_view, fate_count> fate_names = {
    "hit", "absorbed", "escaped", "trapped", "lost"};

/// One photon on its way back from the eye. `direction` is a unit vector.
struct Photon {
  Vec3d position, direction;
  Rgb throughput{1, 1, 1};   ///< share of what it finds that reaches the film
  std::uint32_t sample = 0;  ///< which sample of the film it belongs to
  std::uint32_t slot = 0;    ///< its place among the photons of its wave
  std::uint32_t bounces = 0;
  std::uint32_t pixel_sample = 0;  ///< its number among the samples of its pixel
  std::uint64_t random_key = 0;    ///< (pixel, place in the tree)
  SelfIntersectionGuard guard;     ///< the surface it starts on, if any
  /// Of directions as likely as its own, per solid angle, if lamps are asked for what it finds,
  /// too.
  double density = 0.0;
};

enum class Met : std::uint8_t { nothing, surface, portal_back, mass };

/// Where a photon ended.
struct Arrival {
  Fate fate = Fate::lost;
  Met met = Met::nothing;
  bool out_of_crossings = false;  ///< it is lost at the portal after the last that it might cross
  std::uint32_t object = no_object;  ///< index of the shape, the portal or the mass, as `met` says
  std::uint32_t face = 0;
  std::uint32_t handed_over = 0;  ///< steps that the scalar engine took for the lanes
  Vec3d position, direction;      ///< in the coordinates of where it ended
  Rgb tint{1, 1, 1};              ///< product of the tints of the portals it crossed
  double length = 0.0;            ///< arc length from its start
  double turning = 0.0;           ///< ∫ |dt/ds| ds, radians
  std::uint32_t steps = 0;
  std::uint32_t crossings = 0;
};

}  // namespace portalens
