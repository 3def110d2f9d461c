/// \file
/// Pictures of which some pixels are interpolated, against such as have a photon for every pixel.
#pragma once

#include <cstdint>
#include <string>

#include "differential/draft.h"
#include "differential/stage.h"

namespace portalens::differential {

/// A free scene as `random_scene` draws them, 480 by 270 pixels, with what is easily overlooked
/// added: small balls, thin quads, and portals far away.
[[nodiscard]] Draft random_picture(std::uint64_t seed, std::uint64_t index);

struct PictureComparison {
  bool interpolates = false;  ///< if not, nothing was compared
  std::uint64_t pixels = 0;
  std::uint64_t interpolated = 0;  ///< those without a photon of their own
  std::uint64_t other_way = 0;     ///< that found another fate, object, or other portals
  std::uint64_t over10 = 0;        ///< whose direction is off by more than 10 tolerances
  std::uint64_t misplaced =
      0;  ///< that hit a surface more than 10 tolerances of the path's length off
  std::uint64_t strangers = 0;     ///< that show what no photon of the 3 x 3 about them found
  int worst_x = -1, worst_y = -1;  ///< one of the strangers, or else of the others
};

/// One sample a pixel: `--photons fewer` against `--photons all`.
[[nodiscard]] PictureComparison compare_pictures(const Stage& stage);

}  // namespace portalens::differential
