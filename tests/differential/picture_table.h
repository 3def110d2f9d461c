/// \file
/// What many comparisons of pictures come to.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "differential/picture.h"

namespace portalens::differential {

struct PictureEntry {
  std::uint64_t index = 0;
  std::string kind;
  PictureComparison comparison;
};

/// The rows, what is asked of them, and the worst pictures.
[[nodiscard]] std::string picture_table(const std::vector<PictureEntry>& entries,
                                        std::size_t worst);
/// Whether the rows are within what is asked.
[[nodiscard]] bool pictures_hold(const std::vector<PictureEntry>& entries);

}  // namespace portalens::differential
