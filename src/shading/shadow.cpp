#include "shading/shadow.h"

#include <algorithm>
#include <cmath>

namespace portalens {
namespace {

/// The end of the way that is not looked at, relative to coordinates: the light's own surface lies
/// there, found again with the rounding of its place and of a mesh's candidates.
constexpr double light_margin = 1e-6;

/// How far surfaces that lie in a portal's plane reach in front of it, relative to its size: at a
/// tie the portal comes first (equations.md, sec. 6).
constexpr double portal_margin = 1e-8;

struct Stretch {
  Ray ray;
  double length = 0.0;
};

Stretch stretch(Vec3d from, Vec3d to) {
  const double distance = length(to - from);
  if (!(distance > 0.0)) return {{from, {0, 0, 1}}, 0.0};
  return {{from, (to - from) / distance}, distance};
}

bool meets_horizon(const Space& space, const Stretch& way) {
  return std::any_of(space.masses.begin(), space.masses.end(), [&](const Mass& mass) {
    if (!mass.horizon) return false;
    const Vec3d to_mass = mass.center - way.ray.origin;
    const double along = std::clamp(dot(to_mass, way.ray.direction), 0.0, way.length);
    const Vec3d nearest = to_mass - way.ray.direction * along;
    return dot(nearest, nearest) <= mass.schwarzschild * mass.schwarzschild;
  });
}

bool free_of_surfaces(const Space& space, const Stretch& way, double low, double high,
                      const Departure& departure) {
  return high <= low || !space.surfaces.blocked(way.ray, low, high, departure);
}

/// Where the light's own surface no longer counts.
double short_of_light(const Stretch& way) {
  const Vec3d& x = way.ray.origin;
  const double size = std::max({std::fabs(x.x), std::fabs(x.y), std::fabs(x.z), way.length});
  return way.length - light_margin * size;
}

bool visible_directly(const Space& space, const Stretch& way, double low,
                      const Departure& departure) {
  const double high = short_of_light(way);
  if (high <= low) return true;
  if (space.portals.nearest(way.ray, low, high)) return false;
  return free_of_surfaces(space, way, low, high, departure) && !meets_horizon(space, way);
}

bool visible_through(const Space& space, const ShadowQuery& query) {
  const Portal& portal = space.portals.portals()[query.portal];
  const Stretch unfolded = stretch(query.from, query.to);
  const auto contact = space.portals.nearest(unfolded.ray, 0.0, unfolded.length);
  if (!contact || contact->portal != query.portal || contact->side != PortalSide::front)
    return false;
  const double margin = portal_margin * portal.longest_edge;
  const Stretch before{unfolded.ray, contact->distance};
  if (!free_of_surfaces(space, before, 0.0, contact->distance - margin, query.departure) ||
      meets_horizon(space, before))
    return false;
  const Vec3d entry = portal.through.move(unfolded.ray.at(contact->distance));
  return visible_directly(space, stretch(entry, portal.through.move(query.to)), margin, {});
}

}  // namespace

bool visible(const Space& space, const ShadowQuery& query) {
  if (query.portal != no_portal) return visible_through(space, query);
  return visible_directly(space, stretch(query.from, query.to), 0.0, query.departure);
}

}  // namespace portalens
