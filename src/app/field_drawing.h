/// \file
/// The field on a plane: strength as colour, direction as arrows, portals and masses where they
/// are, and the paths to the faces. Dunigan & Pianta, figures 9 and 10.
#pragma once

#include <cstdint>

#include "app/drawing.h"
#include "app/field_plane.h"

namespace portalens {

/// Which paths from points of the plane to portals are drawn: what of a face pulls at a point.
enum class DrawnWays : std::uint8_t { none, nearest, all };

struct FieldDrawingOptions {
  int width = 800;  ///< pixels, >= 64; the height follows from the plane
  DrawnWays ways = DrawnWays::nearest;
  int threads = 1;
};

[[nodiscard]] Drawing draw_field(const Space& space, const FieldPlane& plane,
                                 const FieldDrawingOptions& options);

}  // namespace portalens
