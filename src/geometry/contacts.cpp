#include "geometry/contacts.h"

#include <numbers>

namespace portalens {

double u_around(Vec3d local) {
  return 0.5 + std::atan2(local.x, local.z) / (2.0 * std::numbers::pi);
}

void put_cap_coordinates(SurfacePoint& point, Vec3d local, double radius, double side) {
  point.u = 0.5 + 0.5 * local.x / radius;
  point.v = 0.5 - 0.5 * side * local.z / radius;
}

}  // namespace portalens
