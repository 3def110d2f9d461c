/// \file
/// How lamps that are asked and photons that find them share the light of a glossy surface, so that
/// none is lost and none counts twice: each gets the part by which it is the likelier to draw that
/// light (the balance heuristic of Veach and Guibas, "Optimally Combining Sampling Techniques",
/// 1995).
///
/// The shares of one path are found alike from both its ends: from what is known of it at the lamp,
/// how far away it started and in which direction it arrives. So they are of one path also where it
/// leads through a portal; and where masses bend it, a rough surface gets its light from lamps that
/// are asked, along straight ways, and a polished one shows what bent light finds.
#pragma once

#include <limits>
#include <type_traits>

#include "photon/photon.h"
#include "shading/appearance.h"

namespace portalens {

/// About how densely per solid angle the points of something are drawn, seen from a distance. Of
/// its area a quarter is seen, in the mean of all sides (Cauchy, of what is convex).
[[nodiscard]] inline double density_of_points(double area, double distance) {
  return 4.0 * distance * distance / area;
}

/// How densely a lamp is drawn; infinite if no photon can find it, and 0 if only photons shall.
template <class Any>
[[nodiscard]] double density_of(const Any& light, const LightSample& sample, Vec3d from) {
  if constexpr (Any::is_delta)
    return std::numeric_limits<double>::infinity();
  else if constexpr (requires { light.density(sample.position); })
    return light.density(sample.position);
  else if constexpr (requires { light.found_area(); })
    return density_of_points(light.found_area(), length(sample.way_from(from)));
  else
    return 0.0;
}

/// The share of those that are drawn with the first density.
[[nodiscard]] inline double share_of(double density, double other) {
  if (!(density > 0.0)) return 0.0;
  return density >= std::numeric_limits<double>::max() ? 1.0 : density / (density + other);
}

/// The share of a photon that was drawn with `photon.density` and has met something that emits.
[[nodiscard]] double share_of_photon(const Appearance& appearance, const Photon& photon,
                                     const Arrival& arrival);

/// What a photon that was drawn with `photon.density` gets of the sky, where it has escaped.
[[nodiscard]] Rgb shared_sky(const Appearance& appearance, const Photon& photon,
                             const Arrival& arrival);

}  // namespace portalens
