/// \file
/// The shortest polyline between two points that touches given lines, one after the other.
#pragma once

#include <array>
#include <cstddef>

#include "math/vec3.h"

namespace portalens {

/// Lines that a polyline may have to touch, at most: portals in a row.
inline constexpr std::size_t max_chain = 16;

/// A point that moves along a line: `start + direction·s`, `low <= s <= high`.
struct Slide {
  Vec3d start, direction;  ///< the direction is a unit vector
  double low, high;

  [[nodiscard]] Vec3d at(double s) const { return start + direction * s; }
};

/// A polyline from `from` over the slides, each at its place, to `to`.
struct Polyline {
  Vec3d from, to;
  std::array<Slide, max_chain> slides;
  std::array<double, max_chain> places;
  std::size_t count = 0;

  [[nodiscard]] Vec3d point(std::size_t i) const { return slides[i].at(places[i]); }
  [[nodiscard]] double total() const;
};

/// Minimises |a - y| + |y - b| over the slide: with both ends turned about its line into one plane,
/// on opposite sides of it, the path is straight.
/// @return the place along the slide
[[nodiscard]] double best_place(const Slide& slide, Vec3d a, Vec3d b);

/// Moves the places to where the polyline is shortest, from any finite ones. The length is convex
/// in the places: projected Newton steps on its tridiagonal Hessian.
/// @return false if it gave up because the polyline can't be shorter than `limit`
bool shorten(Polyline& way, double limit);

}  // namespace portalens
