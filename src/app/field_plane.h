/// \file
/// The rectangle on which `portalens field` draws.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "photon/space.h"

namespace portalens {

struct FieldPlane {
  Vec3d corner;     ///< at the lower left
  Vec3d right, up;  ///< along the lower and the left side, as long as they are; perpendicular
};

/// Seen from the positive side of the third axis, as `draw --view top` sees xz.
/// @param axes   two of x, y, z: the first points to the right, the second up in xy, yz and zx, and
///               down in xz, yx and zy
/// @param cut    the third coordinate; the middle of the masses and portals if absent
/// @param range  from where to where along the first axis, and along the second; if absent, around
///               all masses and portals. Backwards, it is seen in a mirror
/// @throws SceneError if that is no rectangle
[[nodiscard]] FieldPlane plane_along(const std::string& axes, std::optional<double> cut,
                                     const std::optional<std::array<double, 4>>& range,
                                     const Space& space);

/// @param numbers  corner, right, up
/// @throws SceneError if that is no rectangle
[[nodiscard]] FieldPlane plane_of(const std::array<double, 9>& numbers);

/// In words: its axes, and where it cuts the third.
[[nodiscard]] std::string told(const FieldPlane& plane);

}  // namespace portalens
