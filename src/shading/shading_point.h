/// \file
/// The place where a photon met something solid, as shading sees it.
#pragma once

#include <cstdint>
#include <vector>

#include "photon/photon.h"
#include "photon/space.h"
#include "shading/appearance.h"

namespace portalens {

struct ShadingPoint {
  SurfacePoint surface;  ///< for its texture: a quad's u and v only where it is a picture
  Vec3d position;        ///< where rays start
  Vec3d normal;          ///< unit; like the next one on the viewer's side
  Vec3d outward;         ///< unit; of the surface itself, where a mesh interpolates `normal`
  std::uint32_t material = 0;
  std::uint32_t shape = no_object;  ///< none for a portal's back
  std::uint32_t face = 0;
  double reach = 0.0;  ///< of departures

  /// How a ray in `direction` leaves this point.
  [[nodiscard]] Departure leaving(Vec3d direction) const {
    if (shape == no_object) return {};
    return {shape, face, dot(direction, surface.geometric_normal) < 0.0 ? -1.0 : 1.0, reach};
  }
};

/// @pre the arrival has met a surface or a portal's back
[[nodiscard]] ShadingPoint shading_point(const Space& space, const Appearance& appearance,
                                         const Arrival& arrival);
/// The same, for many points.
/// @param extent  the diagonal of the box around all surfaces
[[nodiscard]] ShadingPoint shading_point(const Space& space, const Appearance& appearance,
                                         double extent, const Arrival& arrival);

}  // namespace portalens
