/// \file
/// The planes of flat faces in double, for paths that lanes hand over to the scalar engine. A
/// float's rounding may put the end of a step behind a plane that the path comes to there and that
/// lanes have not seen it meet: in double it would be past the face, and never meet it.
#pragma once

#include <cmath>
#include <vector>

#include "math/vec3.h"
#include "photon/step.h"

namespace portalens {

struct FacePlane {
  Vec3d point, normal;
  float leaves;      ///< what `Lanes::departed` says of paths that have left it
  bool from_behind;  ///< whether paths that come from behind meet the face, too
};

struct FacePlanes {
  std::vector<FacePlane> planes;
  double rounding = 0.0;  ///< as far as that a float may lie from where it should

  /// Where the path is: before the planes that it has only just passed.
  /// @param departed  `Lanes::departed` of the path
  [[nodiscard]] Vec3d before(const State& state, float departed) const {
    Vec3d place = state.position;
    for (const FacePlane& plane : planes) {
      if (departed == plane.leaves) continue;
      const double height = dot(place - plane.point, plane.normal);
      const double slope = dot(state.direction, plane.normal);
      const bool past = slope < 0.0 ? height <= 0.0 : plane.from_behind && height >= 0.0;
      if (!past || std::fabs(height) > rounding) continue;
      place -= plane.normal * (height + std::copysign(2e-3 * rounding, slope));
    }
    return place;
  }
};

}  // namespace portalens
