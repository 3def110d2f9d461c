/// \file
/// The shortest path from a point to another through a row of faces, unfolded: equations.md,
/// sec. 5.
///
/// A path crosses the inside of a face only straight and from front to back; else it bends on the
/// face's rim. For one face the best point of an edge has a closed form (`best_place`). For several
/// the length is convex in the places along given edges, and which edges is found by branch and
/// bound: a face that is left out can only make the path shorter. The rim of an ellipse is all one
/// edge, on which the length may be least at two places; it is followed down from the better.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "gravity/polyline.h"
#include "gravity/portal_face.h"

namespace portalens {

/// The faces of a chain, in the order of passing.
using FaceRow = std::span<const PortalFace* const>;

/// How a path passes one face: straight through its inside, or by a feature of its rim (of an
/// ellipse, by one of some sectors: so that a path which jumps is told from one that slides).
struct Turn {
  enum class Kind : std::uint8_t { straight, edge, vertex };
  Kind kind;
  std::uint32_t index;
  double angle = 0.0;  ///< round an ellipse, where it was found: from there it is followed

  [[nodiscard]] std::uint64_t code() const {
    return static_cast<std::uint64_t>(index) * 4 + static_cast<std::uint64_t>(kind);
  }
};
inline constexpr Turn straight_on{Turn::Kind::straight, 0};

/// The discrete part of a path: one entry a face.
using Turns = std::array<Turn, max_chain>;

/// The continuous part.
struct Way {
  double length = 0.0;
  Vec3d towards;         ///< the first point where it bends, or its end
  bool straight = true;  ///< it bends nowhere
};

/// Finds the turns of the shortest path, if it is shorter than `limit`. Between edges that are
/// equally good the lower index wins.
/// @param from  at height 0 over a face it counts as in front
/// @param to    at height 0 it counts as behind
/// @pre 1 to `max_chain` faces
/// @return whether there is such a way
[[nodiscard]] bool shortest_passages(Vec3d from, Vec3d to, FaceRow faces, double limit, Turns& out);

/// The path with these turns, an edge counting as its whole line: smooth in `from`. Its bends
/// are the points of the polyline, one for each turn that is not straight.
[[nodiscard]] Polyline bends(Vec3d from, Vec3d to, FaceRow faces, const Turns& turns);

/// The length and the first bend of that way.
[[nodiscard]] Way follow(Vec3d from, Vec3d to, FaceRow faces, const Turns& turns);

}  // namespace portalens
