/// \file
/// Mirrors, polished or rough: a microfacet surface with the GGX distribution.
/// Walter et al. 2007; visible normals after Heitz, "Sampling the GGX Distribution of Visible
/// Normals", JCGT 7(4), 2018.
#pragma once

#include <optional>

#include "math/vec3.h"

namespace portalens {

struct Reflection {
  Vec3d direction;      ///< unit, away from the surface
  double weight = 1.0;  ///< share of that direction's radiance, 0 to 1
};

/// One direction from which light comes that leaves against `incoming`. For a visible normal drawn
/// from its distribution the weight is G2/G1 (Smith, heights correlated).
/// @param incoming   unit, towards the surface: dot(incoming, normal) < 0
/// @param normal     unit, on the viewer's side
/// @param roughness  0 to 1; α = roughness², 0 = an exact mirror
/// @param u1,u2      uniform in [0, 1)
/// @return nothing if the direction would lie below the surface
[[nodiscard]] std::optional<Reflection> reflect(Vec3d incoming, Vec3d normal, double roughness,
                                                double u1, double u2);

}  // namespace portalens
