/// \file
/// The light between four neighbouring photons, as a beam in sections.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "math/vec3.h"
#include "photon/path_record.h"

namespace portalens {

/// A place, and how long the path to it is.
using Reached = float __attribute__((vector_size(16)));

[[nodiscard]] inline Vec3d place_of(Reached at) { return {at[0], at[1], at[2]}; }
[[nodiscard]] inline float square_of_place(Reached a) {
  const Reached squares = a * a;
  return squares[0] + squares[1] + squares[2];
}

/// A section of the beam: everything within `from_radius` at its start, growing evenly to
/// `to_radius` at its end. Without values: many of them lie side by side.
struct BeamSection {
  Reached from, to;
  float from_radius, to_radius;
  float reach;  ///< from its middle: radius of the ball that holds it
  std::int32_t stretch;
  bool last;     ///< of its stretch
  bool leaves;   ///< lies where the stretch begins, or nearly
  bool arrives;  ///< and where it ends

  [[nodiscard]] float radius() const { return std::max(from_radius, to_radius); }
};

/// The light between four path records, section by section.
class Beam {
 public:
  /// @pre the path records are known, and entered the same portals
  explicit Beam(const std::array<const PathRecord*, 4>& records);

  [[nodiscard]] std::span<const BeamSection> sections() const {
    return std::span(pieces_).first(count_);
  }

 private:
  void add(Reached from, Reached to, float turning, float from_radius, float to_radius,
           const Waypoint& point, bool last);
  void mark_ends();

  std::size_t count_ = 0;
  std::array<BeamSection, PathRecord::max_points> pieces_;
};

}  // namespace portalens
