/// \file
/// Shadow queries: whether a light's point is seen from a surface's. equations.md, sec. 7.
#pragma once

#include <cstdint>

#include "photon/photon.h"
#include "photon/space.h"

namespace portalens {

/// Light that reaches the film if nothing is in its straight path.
struct ShadowQuery {
  ShadowQuery() {}  // not `= default`: that would clear it as a whole first, which takes long

  Vec3d from;                          ///< the point that is lit
  Vec3d to;                            ///< the light's point; through a portal, its image
  std::uint32_t portal = no_portal;    ///< the portal whose front it comes through
  SelfIntersectionGuard guard;         ///< the surface that is lit
  Rgb contribution;                    ///< to the film, if the path is free
  std::uint32_t sample = 0, slot = 0;  ///< of the photon that asks
};

/// Whether the path is free: of surfaces, portals' fronts, material backs and horizons. Through a
/// portal: both halves are, and the first portal on the path is that one.
[[nodiscard]] bool visible(const Space& space, const ShadowQuery& query);

}  // namespace portalens
