/// \file
/// What is no mistake, but probably not what its author meant.
#pragma once

#include <string>
#include <vector>

namespace portalens {

struct World;

/// @return sentences, in a fixed order
[[nodiscard]] std::vector<std::string> warnings_about(const World& world);

}  // namespace portalens
