/// \file
/// What is no mistake, but probably not what its author meant; and what is worth knowing besides.
#pragma once

#include <string>
#include <vector>

namespace portalens {

struct World;

/// Sentences, in a fixed order.
struct Observations {
  std::vector<std::string> warnings;  ///< what is probably not meant
  std::vector<std::string> remarks;   ///< what is as it should be, and worth knowing
};

[[nodiscard]] Observations observations_about(const World& world);

}  // namespace portalens
