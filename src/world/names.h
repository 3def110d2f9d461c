/// \file
/// The names of a scene: every table may have one, and no two have the same.
#pragma once

#include <map>
#include <string>

#include "core/parameters.h"

namespace portalens {

class Names {
 public:
  /// The table's `name`; without one, its kind and its index among the tables of that kind
  /// (`sphere0`). A name that is taken is a fault.
  std::string claim(Parameters& parameters);

 private:
  std::map<std::string, Location> taken_;
  std::map<std::string, int> count_of_;
};

}  // namespace portalens
