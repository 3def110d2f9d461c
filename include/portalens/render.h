/// \file
/// Taking the picture of a world, into memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "portalens/picture.h"
#include "portalens/types.h"
#include "portalens/world.h"

namespace portalens::api {

/// By which engine photons go.
enum class Engine {
  automatic,  ///< many at once in floats, where the scene allows it
  scalar,     ///< one by one in double
};

/// Whether every sample has a photon of its own.
enum class Photons {
  fewer,  ///< where neighbours agree, what is between them is interpolated
  all,
};

/// What a picture can tell besides light; docs/see-why.md says what each means, and its unit.
enum class Layer {
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

/// How far a render is.
struct Progress {
  std::size_t done = 0, total = 0;  ///< pixels
  std::uint64_t photons = 0;        ///< that were followed so far
  Window window;                    ///< what the picture is of
  Window tile;                      ///< what was completed last
  /// The picture of `window` as in `Picture::rgb`, while the callback lasts. Only pixels of tiles
  /// that were told may be read.
  std::span<const float> rgb;
};

struct RenderOptions {
  int threads = 0;  ///< >= 0; 0: as many as the machine runs at once
  Engine engine = Engine::automatic;
  Photons photons = Photons::fewer;
  std::optional<Window> crop;  ///< the part to take; by default the whole picture
  std::vector<Layer> layers;   ///< to take besides
  /// Called as tiles are completed, by one thread at a time, not always the same. What it throws
  /// ends the render, and comes out of `render`.
  std::function<void(const Progress&)> progress;
  /// Asked often, by all threads at once: whether to stop. It must not throw.
  std::function<bool()> cancelled;
};

/// What came of it.
struct Rendering {
  Picture picture;  ///< of `window`; pixels that a cancelled render did not reach are 0
  Window window;
  bool complete = false;                 ///< false if it was cancelled
  std::array<std::uint64_t, 5> fates{};  ///< how many photons ended so, in the order of `Fate`
  std::uint64_t photons = 0;             ///< all of them, with those from mirrors
  double seconds = 0.0;                  ///< of wall time

  [[nodiscard]] std::uint64_t ended(Fate fate) const {
    return fates[static_cast<std::size_t>(fate)];
  }
};

/// Takes the picture. It is the same bits whatever the threads and the crop; a cancellation is
/// obeyed after some tenths of a second.
/// @throws Error (asked) if the options ask for what is not there, Error (work) if memory runs out
[[nodiscard]] Rendering render(const World& world, const RenderOptions& options = {});

/// What the numbers of the layer `object` stand for: number n is the name n - 1 of these; 0 is
/// none.
[[nodiscard]] std::vector<std::string> layer_objects(const World& world);

}  // namespace portalens::api
