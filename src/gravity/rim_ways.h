/// \file
/// How a path passes one face: straight through its inside, or over a piece of its rim.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "gravity/polyline.h"
#include "gravity/portal_face.h"
#include "gravity/shortest_way.h"
#include "gravity/way_formulas.h"

namespace portalens {

/// Lengths of paths over the insides of edges that differ by less than this share are a tie.
inline constexpr double length_tie = 1e-13;

/// Where, as a share of its length, the segment from a to b crosses the face from front to back;
/// negative if it doesn't. Ends are given in the face's coordinates.
[[nodiscard]] inline double straight_through(const PortalFace& face, Vec3d a, Vec3d b) {
  if (a.z < -face.height_tolerance() || b.z > face.height_tolerance()) return -1.0;
  const double above = std::max(a.z, 0.0), below = std::max(-b.z, 0.0);
  const double t = above > 0.0 ? above / (above + below) : 0.0;
  const bool crosses = face.covers(a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t);
  return crosses ? t : -1.0;
}

/// Edges, or the whole rim of an ellipse.
[[nodiscard]] inline std::uint32_t rim_pieces(const PortalFace& face) {
  return face.ellipse() ? 1 : static_cast<std::uint32_t>(face.edges().size());
}

/// A piece of the rim, in the face's coordinates or in space.
[[nodiscard]] inline Slide slide_on(const Ellipse& ellipse, const Frame& frame) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return {frame.origin, frame.right * ellipse.a(), -infinity, infinity,
          true,         frame.up * ellipse.b()};
}
[[nodiscard]] inline Slide local_slide(const Ellipse& ellipse) {
  return slide_on(ellipse, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
}
[[nodiscard]] inline Slide slide_of(const PortalFace& face, std::uint32_t piece) {
  if (const Ellipse* ellipse = face.ellipse()) return slide_on(*ellipse, face.frame());
  const FaceEdge& edge = face.edges()[piece];
  return {edge.start, edge.direction, 0.0, edge.length};
}

[[nodiscard]] inline Turn rim_turn(const PortalFace& face, std::uint32_t edge, double place) {
  if (face.ellipse()) {
    constexpr double sectors = 16.0;
    const double turns = place / (2.0 * std::numbers::pi);
    const double share = turns - std::floor(turns);
    return {Turn::Kind::edge, static_cast<std::uint32_t>(share * sectors), place};
  }
  const auto count = static_cast<std::uint32_t>(face.edges().size());
  if (place <= 0.0) return {Turn::Kind::vertex, edge};
  if (place >= face.edges()[edge].length) return {Turn::Kind::vertex, (edge + 1) % count};
  return {Turn::Kind::edge, edge};
}

/// The best way over one piece of the rim; ends in the face's coordinates.
[[nodiscard]] inline RimWay<double> over_piece(const PortalFace& face, std::uint32_t piece, Vec3d a,
                                               Vec3d b) {
  if (const Ellipse* ellipse = face.ellipse()) {
    const CurvePlace best = least_places(local_slide(*ellipse), a, b).front();
    return {best.length, best.angle};
  }
  const FaceEdge& edge = face.edges()[piece];
  const double outside_a = edge.outside(a.x, a.y), outside_b = edge.outside(b.x, b.y);
  const BesideLine<double> ends{edge.along(a.x, a.y), std::sqrt(outside_a * outside_a + a.z * a.z),
                                edge.along(b.x, b.y), std::sqrt(outside_b * outside_b + b.z * b.z)};
  return over_rim(ends, edge.length);
}

}  // namespace portalens
