#include "shading/shading_point.h"

#include <algorithm>

namespace portalens {
namespace {

/// A portal's back is a flat face in the portal's own frame: lengths from its first vertex, and
/// texture coordinates from 0 to 1 over its bounding rectangle.
SurfacePoint place_on_back(const Portal& portal, Vec3d x) {
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

}  // namespace

ShadingPoint ShadingPoints::at(const Arrival& arrival) const {
  if (arrival.met == Met::portal_back) return on_back(arrival);
  if (const Quad* quad = plain_quad(arrival)) return on(*quad, arrival);
  return on_surface(arrival,
                    space_.surfaces.surface_at(arrival.object, arrival.face, arrival.position));
}

ShadingPoint ShadingPoints::on_back(const Arrival& arrival) const {
  const Portal& portal = space_.portals.portals()[arrival.object];
  ShadingPoint point;
  point.material = *portal.back_material;
  point.diffuse = color_at(appearance_.materials[point.material].diffuse,
                           place_on_back(portal, arrival.position));
  point.normal = point.outward = -portal.frame.normal;
  const double height = dot(arrival.position - portal.frame.origin, portal.frame.normal);
  point.position = arrival.position - portal.frame.normal * height;
  point.shape = static_cast<std::uint32_t>(shapes_.size()) + arrival.object;
  point.front = -1.0;
  point.size = length(point.position) + portal.longest_edge;
  return point;
}

}  // namespace portalens
