/// \file
/// How far photons land from where they should.
#pragma once

#include <span>
#include <string>

#include "photon/photon.h"
#include "world/world.h"

namespace portalens::benchmarks {

struct Errors {
  double median = 0, p99 = 0, p9999 = 0, most = 0;  ///< pixels
  double mismatch = 0;  ///< share that has another fate, object, or number of crossings
};

/// A hit's miss in pixels is its distance divided by the length of the path and the angle of a
/// pixel; that of an escaped photon the angle between the directions, in pixels.
/// @pre as many arrivals on both sides
[[nodiscard]] Errors errors_of(std::span<const Arrival> arrivals, std::span<const Arrival> exact,
                               double pixel);

/// A benchmark does not time what is wrong: throws unless fates agree but for a hundredth, and half
/// of the photons land within a tenth of a pixel, and 99 of 100 within one.
/// @param pixels  how many of the picture's pixels make one of these
/// @throws WorkError with what was checked and how wrong it is
void demand_sound(const Errors& errors, const std::string& what, double pixels = 1.0);

/// The angle between two pixels in the middle of the film, radians.
[[nodiscard]] double pixel_angle(const World& world);

}  // namespace portalens::benchmarks
