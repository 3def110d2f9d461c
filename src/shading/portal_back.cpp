#include "shading/portal_back.h"

namespace portalens {

SurfacePoint point_on_back(const Portal& portal, Vec3d x) {
  const Vec3d local = portal.frame.to_local(x);
  const PlaneBox box = box_of(portal.aperture);
  const Vec3d low{box.low_x, box.low_y, 0.0}, high{box.high_x, box.high_y, 0.0};
  const Vec3d first = is_curved(portal.aperture) ? low : portal.frame.to_local(portal.vertices[0]);
  SurfacePoint point;
  point.position = x;
  point.normal = portal.frame.normal;
  point.geometric_normal = portal.frame.normal;
  point.u = (local.x - low.x) / (high.x - low.x);
  point.v = (local.y - low.y) / (high.y - low.y);
  point.flat = true;
  point.along = local.x - first.x;
  point.across = local.y - first.y;
  return point;
}

}  // namespace portalens
