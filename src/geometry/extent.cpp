#include "geometry/extent.h"

#include <cmath>
#include <string>

#include "geometry/polygon.h"

namespace portalens {

bool extent_allowed(Parameters& parameters, std::string_view key, const Box& box, double least) {
  const double farthest = std::fmax(largest_component(box.low), largest_component(box.high));
  if (!(farthest <= largest_coordinate)) {
    parameters.fault(key, "the " + parameters.kind() + " reaches beyond 1e12",
                     "keep every coordinate between -1e12 and 1e12");
    return false;
  }
  if (!(least >= smallest_length) || !(least >= 1e-12 * farthest)) {
    parameters.fault(key, "the " + parameters.kind() + " is too small for where it stands",
                     "make each of its lengths at least 1e-9, and 1e-12 of its distance from the "
                     "origin");
    return false;
  }
  return true;
}

}  // namespace portalens
