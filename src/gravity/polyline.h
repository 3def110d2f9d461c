/// \file
/// The shortest polyline between two points that touches given lines or ellipses, one after the
/// other.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "math/vec3.h"

namespace portalens {

/// Lines that a polyline may have to touch, at most: portals in a row.
inline constexpr std::size_t max_chain = 16;

/// A point that moves along a line: `start + direction·s`, `low <= s <= high`. Or round an ellipse
/// about `start`: `start + direction·cos s + across·sin s`.
struct Slide {
  Vec3d start, direction;  ///< of a line, a unit vector
  double low, high;        ///< none of an ellipse: infinite
  bool curved = false;
  Vec3d across{};

  [[nodiscard]] Vec3d at(double s) const {
    if (curved) return start + direction * std::cos(s) + across * std::sin(s);
    return start + direction * s;
  }
  /// How far the point moves as `s` does, at the most.
  [[nodiscard]] double scale() const {
    return curved ? std::fmax(length(direction), length(across)) : 1.0;
  }
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

/// A place round an ellipse where the length of the path over it is least about it, and that
/// length.
struct CurvePlace {
  double angle = 0.0, length = 0.0;
};
/// All of them, the least first.
/// @pre the slide is curved
[[nodiscard]] std::vector<CurvePlace> least_places(const Slide& slide, Vec3d a, Vec3d b);
/// From a place round an ellipse down to where |a - y| + |y - b| is least about it.
[[nodiscard]] double follow_curve(const Slide& slide, double place, Vec3d a, Vec3d b);

/// Moves the places to where the polyline is shortest, from any finite ones. The length is convex
/// in the places on lines: projected Newton steps on its tridiagonal Hessian. Round ellipses it
/// goes down to where it is least about the first places.
/// @return false if it gave up because the polyline can't be shorter than `limit`
bool shorten(Polyline& way, double limit);

}  // namespace portalens
