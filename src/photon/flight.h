/// \file
/// How far light flies straight on before anything acts on it.
#pragma once

#include <cmath>

#include "geometry/ray.h"
#include "photon/space.h"
#include "photon/vicinity.h"

namespace portalens {

/// Where something begins to act on a straight flight between `low` and `high`, by bisection;
/// `high` if nothing acts there yet, since `free_flight` stops short of where a coupling acts.
template <class F>
[[nodiscard]] double onset(const Space& space, const F& field, Vicinity& vicinity, const Ray& ray,
                           double low, double high) {
  const auto acts = [&](double s) {
    vicinity.cover(ray.at(s), 0.0);
    return field.acts(ray.at(s), vicinity.near());
  };
  if (!acts(high)) return high;
  while (high - low > 1e-11 * space.extent) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (acts(middle) ? high : low) = middle;
  }
  return high;
}

/// Where on a straight flight something begins to act, or infinity.
/// @param vicinity  is moved along
template <class F>
[[nodiscard]] double reach_of_flight(const Space& space, const F& field, Vicinity& vicinity,
                                     const Ray& ray) {
  const double resolution = 1e-7 * space.extent;
  const double near = field.free_flight(ray, resolution, 1e3 * space.extent + length(ray.origin));
  return std::isfinite(near) ? onset(space, field, vicinity, ray, near, near + 2.0 * resolution)
                             : near;
}

}  // namespace portalens
