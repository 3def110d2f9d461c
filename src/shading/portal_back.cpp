#include "shading/portal_back.h"

#include <algorithm>

namespace portalens {

SurfacePoint point_on_back(const Portal& portal, Vec3d x) {
  const Vec3d local = portal.frame.to_local(x);
  const Vec3d first = portal.frame.to_local(portal.vertices[0]);
  Vec3d low = first, high = first;
  for (const Vec3d& vertex : portal.vertices) {
    const Vec3d corner = portal.frame.to_local(vertex);
    low = {std::min(low.x, corner.x), std::min(low.y, corner.y), 0.0};
    high = {std::max(high.x, corner.x), std::max(high.y, corner.y), 0.0};
  }
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
