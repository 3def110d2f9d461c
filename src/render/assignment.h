/// \file
/// Which part of which picture is to be taken.
#pragma once

#include <cstdint>
#include <vector>

#include "render/film.h"
#include "render/layers.h"
#include "render/sample_sum.h"

namespace portalens {

struct Assignment {
  Window film;                ///< the whole picture, from (0, 0)
  Window window;              ///< the pixels that are taken, some of the film's
  std::uint32_t samples = 1;  ///< of each pixel of the whole picture
  SampleRange range;          ///< those of them that are taken; not empty
  std::vector<Layer> layers;  ///< of the whole picture; in the order of `Layer`, each once
  int tile_size = 32;         ///< pixels along a tile's side, >= 1

  /// Whether the pixels that are taken are then complete.
  [[nodiscard]] bool whole_pixels() const { return range == SampleRange{0, samples}; }
  /// Layers tell of each pixel's first sample: who takes that, takes them.
  [[nodiscard]] bool takes_layers() const { return !layers.empty() && range.begin == 0; }
};

}  // namespace portalens
