/// \file
/// Taking the picture of a world.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/image.h"
#include "photon/engine.h"
#include "render/camera_photon.h"
#include "render/film.h"
#include "render/tally.h"
#include "world/world.h"

namespace portalens {

struct RenderOptions {
  int threads = 0;     ///< 0: as many as the machine runs at once
  int tile_size = 32;  ///< pixels along a tile's side, >= 1
  Engine engine = Engine::automatic;
  std::optional<Window> crop;  ///< the part of the picture to take; it must lie within the film
};

/// Told how far a picture is, and asked whether to go on. Called by one thread at a time.
class Progress {
 public:
  virtual ~Progress() = default;
  /// `done` of `total` pixels stand, which took so many photons.
  virtual void advanced(std::size_t done, std::size_t total, const Tally& tally) = 0;
  /// A tile stands in the picture of `window`; of the other pixels nothing may be read.
  virtual void tile_taken(const Window& /*tile*/, const Image& /*film*/, const Window& /*window*/) {
  }
};

/// Asked often, by all threads at once.
class Cancellation {
 public:
  virtual ~Cancellation() = default;
  [[nodiscard]] virtual bool requested() const = 0;
};

/// How many pixels with lost photons are remembered.
inline constexpr std::size_t most_lost = 8;

enum class Completion { complete, cancelled };

struct RenderResult {
  Image image;  ///< of the window; linear R, G, B. Pixels not reached before a cancellation are 0
  Window window;
  Tally tally;
  /// The first sample of which a photon was lost, of each of the first few such pixels.
  std::vector<PixelSample> lost;
  double seconds = 0.0;  ///< of wall time
  Completion completion = Completion::complete;
};

/// A pixel is the mean of its samples (box filter); a single sample lies in its centre. The picture
/// is the same bits whatever the threads, the tiles and the window: a pixel depends on the world
/// and on its own place alone.
/// @throws what working may (std::bad_alloc)
[[nodiscard]] RenderResult render(const World& world, const RenderOptions& options,
                                  Progress* progress = nullptr,
                                  const Cancellation* cancellation = nullptr);

}  // namespace portalens
