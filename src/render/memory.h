/// \file
/// What a picture will take of the machine's memory, estimated before it is begun.
#pragma once

#include <cstddef>
#include <cstdint>

#include "render/film.h"
#include "world/world.h"

namespace portalens {

/// Bytes at the peak; meant to be right within a factor of two, and rather too many.
struct MemoryEstimate {
  std::uint64_t program = 0;  ///< what the program and its libraries take for a scene of nothing
  std::uint64_t scene = 0;    ///< textures, and meshes with what finds their triangles
  std::uint64_t picture = 0;  ///< the film, its layers, and their copies while they are encoded
  std::uint64_t photons = 0;  ///< on their paths, in all threads

  [[nodiscard]] std::uint64_t total() const { return program + scene + picture + photons; }
};

/// @param layer_channels  channels beside R, G, B
/// @param threads         >= 1
/// @param tile_size       pixels along a tile's side, >= 1: what stands between them is kept while
///                        a tile is taken
[[nodiscard]] MemoryEstimate estimated_memory(const World& world, const Window& window,
                                              std::size_t layer_channels, int threads,
                                              int tile_size);

}  // namespace portalens
