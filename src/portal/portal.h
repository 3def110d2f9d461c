/// \file
/// A portal: a one-sided planar face, and the passage that leads through it.
/// Dunigan & Pianta, sec. 4; the map is equations.md, sec. 4.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "portal/aperture.h"
#include "portal/passage.h"

namespace portalens {

struct Portal {
  std::string name;
  /// Counter-clockwise seen from the front: its corners, or those of a polygon around a curved rim.
  std::vector<Vec3d> vertices;
  Frame frame;                ///< right along a polygon's first edge, normal towards the front
  Aperture aperture;          ///< the same in coordinates of the frame
  double longest_edge = 0.0;  ///< or the diameter of what is curved
  std::uint32_t pair = 0;     ///< index of the other member
  Passage passage;            ///< from this front to the pair's
  Rgb tint{1, 1, 1};
  std::optional<std::uint32_t> back_material;  ///< none: no surface meets light from behind
  /// What meets its back leaves the back of its pair, by the same passage. Else, without a
  /// material, light passes from behind as if nothing were there.
  bool two_sided = false;

  /// Whether light that comes from behind meets it.
  [[nodiscard]] bool has_back() const { return two_sided || back_material.has_value(); }

  /// The rigid motion that its passage is: T_A; null where it is none.
  [[nodiscard]] const Rigid* motion() const { return motion_of(passage); }

  /// Heights within this of the plane count as 0, and a point at height 0 is in front.
  [[nodiscard]] double height_tolerance() const { return 1e-9 * longest_edge; }
};

/// The input of a polygon's face, with its frame.
/// @pre as `polygon_frame`
[[nodiscard]] FaceInput polygon_input(std::vector<Vec3d> vertices);

/// Gives a portal its face: vertices, frame, aperture and longest edge.
/// @pre an aperture takes the input
void give_face(Portal& portal, const FaceInput& input);

/// Convex polygons in space that make up a portal's face; of a curved one they are a little more.
[[nodiscard]] std::vector<std::vector<Vec3d>> pieces_of(const Portal& portal);
/// Those that its face lacks to be convex itself.
[[nodiscard]] std::vector<std::vector<Vec3d>> gaps_of(const Portal& portal);

/// A portal's aperture where its face is carried elsewhere, or turned over.
[[nodiscard]] Aperture aperture_at(const Portal& portal, const std::vector<Vec3d>& vertices,
                                   const Frame& frame);

/// The frame of a planar polygon: origin in the mean of the vertices, `right` along the first edge,
/// `normal` by Newell's method.
/// @pre at least 3 vertices that are not on one line
[[nodiscard]] Frame polygon_frame(const std::vector<Vec3d>& vertices);

/// The portals as gravity counts them: a two-sided pair is two one-sided pairs back to back. The
/// reverses of two-sided portals follow the portals, in their order; they lead through by the same
/// passage.
[[nodiscard]] std::vector<Portal> one_sided(std::span<const Portal> portals);

/// Largest distance between A's vertices moved through and the B's that correspond to them
/// (A's v0, v1 land on B's v1, v0), divided by the longest edge; infinite if the counts differ.
[[nodiscard]] double congruence_error(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b);

}  // namespace portalens
