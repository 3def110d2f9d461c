/// \file
/// Taking the picture of a world.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/image.h"
#include "io/image.h"
#include "lanes/engine.h"
#include "render/exposure.h"
#include "render/tally.h"
#include "world/world.h"

namespace portalens {

/// Whether every sample has a photon of its own, or what it would find is interpolated where its
/// neighbours agree (sampling_grid.h). Only lanes know how.
enum class Photons : std::uint8_t { fewer, all };

struct RenderOptions {
  int threads = 0;               ///< 0: as many as the machine runs at once
  std::optional<int> tile_size;  ///< pixels along a tile's side, >= 1; by default `tile_size_of`
  Engine engine = Engine::automatic;
  Photons photons = Photons::fewer;
  std::optional<Window> crop;  ///< the part of the picture to take; it must lie within the film
  std::optional<SampleRange> samples;  ///< those to take of each pixel's; by default all
  std::vector<Layer> layers;           ///< to take besides; in the order of `Layer`, each once
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

enum class Completion { complete, cancelled };

struct RenderResult {
  Image image;  ///< of the window; linear R, G, B. Pixels not reached before a cancellation are 0
  std::vector<Channel> layers;  ///< those asked for, likewise
  Window window;
  SampleRange samples;
  Tally tally;
  /// The first sample of which a photon was lost, of each of the first few such pixels.
  std::vector<PixelSample> lost;
  double seconds = 0.0;  ///< of wall time
  Completion completion = Completion::complete;
};

/// Pixels along a tile's side.
[[nodiscard]] int tile_size_of(const World& world, const RenderOptions& options);

/// What the options ask of a world's picture.
[[nodiscard]] Assignment assignment_of(const World& world, const RenderOptions& options);

/// Whether samples of the world's picture may be interpolated.
[[nodiscard]] bool interpolates(const World& world, const RenderOptions& options);

/// Goes on with an exposure until it is complete or cancelled. A pixel is the mean of its samples
/// (box filter); a single sample lies in its centre. The picture is the same bits whatever the
/// threads, the tiles, the window and the interruptions: a pixel depends on the world and on its
/// own place alone. A cancellation is obeyed after some tenths of a second, within a tile; only
/// where a single photon takes longer it waits for that.
/// @param options  of which the threads, the engine and the photons are used
/// @throws what working may (std::bad_alloc)
void expose(const World& world, Exposure& exposure, const RenderOptions& options,
            Progress* progress = nullptr, const Cancellation* cancellation = nullptr);

/// What stands of an exposure, also while it goes on.
[[nodiscard]] RenderResult result_of(const Exposure& exposure);

/// Assignment, exposure and result in one.
[[nodiscard]] RenderResult render(const World& world, const RenderOptions& options,
                                  Progress* progress = nullptr,
                                  const Cancellation* cancellation = nullptr);

}  // namespace portalens
