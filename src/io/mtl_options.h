/// \file
/// The options that stand before the file of an MTL map.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace portalens {

/// Where the file's name begins, and which options ask for what is not done here.
struct MapOptions {
  std::size_t name = 1;               ///< the index of its first word
  std::vector<std::string> not_done;  ///< each with its values
};

/// @param words  of a line such as `map_Kd -s 2 2 1 wood.png`
[[nodiscard]] MapOptions map_options(const std::vector<std::string_view>& words);

}  // namespace portalens
