/// \file
/// What the shapes have in common that are round about their own y axis: walls and caps.
#pragma once

#include "geometry/clearance.h"
#include "geometry/flat_face.h"
#include "geometry/pose.h"

namespace portalens {

/// Distance from the y axis.
[[nodiscard]] inline double axis_distance(Vec3d p) { return std::hypot(p.x, p.z); }

/// The unit vector away from the y axis; +z on it.
[[nodiscard]] inline Vec3d away_from_axis(Vec3d p) {
  const double distance = axis_distance(p);
  return distance > 0.0 ? Vec3d{p.x / distance, 0.0, p.z / distance} : Vec3d{0, 0, 1};
}

/// The point at this height and distance from the axis, this share of the way round.
[[nodiscard]] Vec3d around_axis(double radius, double height, double share);

/// Considers the contacts with an upright wall between -half and +half.
void consider_wall(NearestContact& nearest, const CenteredRay& ray, double radius, double half,
                   std::uint32_t face);
/// Considers the contact with a flat ring at this height, between two distances from the axis.
void consider_cap(NearestContact& nearest, const CenteredRay& ray, double height, double inner,
                  double outer, std::uint32_t face);
/// A cap of that outer radius as a flat face: its hull is a polygon around the disc.
[[nodiscard]] FlatFace flat_cap(const Pose& pose, std::uint32_t face, double height, double radius);

/// The points that an upright cylinder fills.
struct SolidCylinder {
  double radius, half;

  [[nodiscard]] Vec3d closest(Vec3d p) const;
  [[nodiscard]] double depth(Vec3d p) const {
    return std::fmin(radius - axis_distance(p), half - std::fabs(p.y));
  }
};

}  // namespace portalens
