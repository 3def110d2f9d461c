/// \file
/// When two photons went the same way, and how far they are apart if they did.
#pragma once

#include <cmath>
#include <limits>

#include "photon/photon.h"

namespace portalens::differential {

/// The same fate, the same thing met, and the same portals crossed: in drafts each portal has a
/// tint of its own, so the tint tells which.
[[nodiscard]] inline bool same_way(const Arrival& a, const Arrival& b) {
  return a.fate == b.fate && a.met == b.met && a.object == b.object && a.crossings == b.crossings &&
         length(a.tint - b.tint) < 1e-9;
}

/// Between directions at the end, radians; infinite where one is not finite.
[[nodiscard]] inline double angle_between(const Arrival& a, const Arrival& b) {
  const double apart = length(a.direction - b.direction);
  return std::isfinite(apart) ? apart : std::numeric_limits<double>::infinity();
}

/// The same of photons that went the same way; 0 where nobody sees the direction, since they were
/// swallowed, or lost on their path.
[[nodiscard]] inline double direction_apart(const Arrival& a, const Arrival& b) {
  const bool seen = a.fate == Fate::hit || a.fate == Fate::escaped;
  return seen ? angle_between(a, b) : 0.0;
}

}  // namespace portalens::differential
