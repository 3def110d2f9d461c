/// \file
/// What a picture can tell of its photons besides their light: distance, normal, fate, ...
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lanes/engine.h"
#include "world/world.h"

namespace portalens {

enum class Layer : std::uint8_t {
  depth,
  normal,
  albedo,
  object,
  fate,
  steps,
  turning,
  crossings,
  order,
  position
};
inline constexpr int layer_count = 10;
inline constexpr std::array<std::string_view, layer_count> layer_names = {
    "depth", "normal",  "albedo",    "object", "fate",
    "steps", "turning", "crossings", "order",  "position"};

/// The names of a layer's channels as compositing programs expect them: `depth.Z`, `N.X` `N.Y`
/// `N.Z`, `albedo.R` `.G` `.B`, `P.X` `.Y` `.Z`; numbers and counts are `<layer>.X`.
[[nodiscard]] std::vector<std::string> channel_names(Layer layer);

/// Depth of what is not there.
inline constexpr double no_depth = 1e10;

/// What the layers tell of one photon, up to its first surface.
struct FirstHit {
  double depth = no_depth;   ///< arc length from the camera to a surface or a horizon
  Vec3d normal;              ///< unit, on the viewer's side; 0 where no surface is hit
  Rgb albedo;                ///< diffuse reflectance there, before any tint; 0 where none
  std::uint32_t object = 0;  ///< 1 + index into `object_names`; 0: none
  Fate fate = Fate::lost;
  std::uint32_t steps = 0;
  double turning = 0.0;  ///< radians
  std::uint32_t crossings = 0;
  std::uint32_t order = 0;  ///< of the image: half turns about a mass; see `image_order`
  Vec3d position;           ///< where the photon ended, in the coordinates of where it ended
};

/// The channels' values of a layer, in the order of `channel_names`. Numbers that are not finite
/// become 0.
[[nodiscard]] std::vector<float> channel_values(const FirstHit& first_hit, Layer layer);

[[nodiscard]] FirstHit first_hit_of(const World& world, const Arrival& arrival,
                                    const PathTrace& path_trace);

/// Whole half turns that the path makes about a mass, at most about any: 0 for a direct image, 1
/// for the one seen past its other side, 2 once round, ... Angles at the centre of the mass are
/// summed along each stretch between portals; a photon that escapes goes on straight.
[[nodiscard]] std::uint32_t image_order(std::span<const Mass> masses, const Arrival& arrival,
                                        const PathTrace& path_trace);

/// Surfaces, then portals, then masses, each in the order of the scene.
[[nodiscard]] std::vector<std::string> object_names(const World& world);

/// How many channels the layers have.
[[nodiscard]] std::size_t channel_count(std::span<const Layer> layers);

/// The channels' values of these layers at a pixel, which tells of its first sample, which the
/// scalar engine follows: the same as `trace --pixel X Y --sample 0`.
/// @param values  gets them; `channel_count(layers)` long
void take_layers(const World& world, int x, int y, std::span<const Layer> layers,
                 std::span<float> values);

}  // namespace portalens
