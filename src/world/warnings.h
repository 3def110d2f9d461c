/// \file
/// What is no mistake, but probably not what its author meant; and what is worth knowing besides.
#pragma once

#include <string>
#include <vector>

namespace portalens {

struct World;

/// @return sentences, in a fixed order
[[nodiscard]] std::vector<std::string> warnings_about(const World& world);

/// The camera within the influence of a mass, as in most pictures of lenses: its light is bent from
/// the start, and what lies beyond the influence is not bent by it.
[[nodiscard]] std::vector<std::string> remarks_about(const World& world);

}  // namespace portalens
