#include "shading/shading_point.h"

#include <algorithm>

namespace portalens {
namespace {

/// Rays from a portal's material back start this far behind its plane, relative to its longest
/// edge: more than the tolerance within which a point still counts as in front.
constexpr double behind_portal = 1e-7;

/// Departures hold over this share of the place's and the scene's size.
constexpr double departure_share = 1e-6;

/// A portal's back is a flat face in the portal's own frame: lengths from its first vertex, and
/// texture coordinates from 0 to 1 over its bounding rectangle.
SurfacePoint on_back(const Portal& portal, Vec3d x) {
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

ShadingPoint point_on_back(const Portal& portal, const Arrival& arrival) {
  ShadingPoint point;
  point.surface = on_back(portal, arrival.position);
  point.material = *portal.back_material;
  point.normal = point.outward = -portal.frame.normal;
  const double height = dot(arrival.position - portal.frame.origin, portal.frame.normal);
  point.position =
      arrival.position - portal.frame.normal * (height + behind_portal * portal.longest_edge);
  return point;
}

/// The place on its surface, as far as its material asks for it: a checker on a quad needs no u, v.
SurfacePoint surface_for(const Space& space, const Material& material, const Arrival& arrival) {
  const auto* quad = std::get_if<Quad>(&space.surfaces.shapes()[arrival.object]);
  if (quad && !std::holds_alternative<Picture>(material.diffuse))
    return quad->place_at(arrival.position);
  return space.surfaces.surface_at(arrival.object, arrival.face, arrival.position);
}

ShadingPoint point_on_surface(const Space& space, const Appearance& appearance, double extent,
                              const Arrival& arrival) {
  const std::uint32_t object = arrival.object, face = arrival.face;
  const std::uint32_t material = appearance.bodies[object].material_of(face);
  ShadingPoint point{surface_for(space, appearance.materials[material], arrival),
                     arrival.position,
                     {},
                     {},
                     material,
                     object,
                     face,
                     departure_share * (length(arrival.position) + extent)};
  const SurfacePoint& surface = point.surface;
  const bool behind = dot(arrival.direction, surface.geometric_normal) > 0.0;
  point.outward = behind ? -surface.geometric_normal : surface.geometric_normal;
  point.normal = behind ? -surface.normal : surface.normal;
  // At the edge of its silhouette a mesh may be seen where its smooth normal looks away.
  if (dot(arrival.direction, point.normal) >= 0.0) point.normal = point.outward;
  return point;
}

}  // namespace

ShadingPoint shading_point(const Space& space, const Appearance& appearance,
                           const Arrival& arrival) {
  return shading_point(space, appearance, space.surfaces.bounds().diagonal(), arrival);
}

ShadingPoint shading_point(const Space& space, const Appearance& appearance, double extent,
                           const Arrival& arrival) {
  return arrival.met == Met::portal_back
             ? point_on_back(space.portals.portals()[arrival.object], arrival)
             : point_on_surface(space, appearance, extent, arrival);
}

}  // namespace portalens
