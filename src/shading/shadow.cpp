#include "shading/shadow.h"

#include <algorithm>
#include <cmath>

#include "photon/obstacles.h"

namespace portalens {
namespace {

/// The end of the path that is not looked at, relative to coordinates: the light's own surface lies
/// there, found again with the rounding of its place and of a mesh's candidates.
constexpr double light_margin = 1e-6;

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
    return dot(nearest, nearest) <= mass.horizon_radius * mass.horizon_radius;
  });
}

/// Where the light's own surface no longer counts.
double short_of_light(const Stretch& way) {
  const Vec3d& x = way.ray.origin;
  const double size = std::max({std::fabs(x.x), std::fabs(x.y), std::fabs(x.z), way.length});
  return way.length - light_margin * size;
}

bool visible_directly(const Space& space, const Stretch& way, const SelfIntersectionGuard& guard) {
  const double high = short_of_light(way);
  if (high <= 0.0) return true;
  if (space.portals.nearest(way.ray, 0.0, high, space.surfaces.flush().left_by(guard)))
    return false;
  return !space.surfaces.blocked(way.ray, 0.0, high, guard) && !meets_horizon(space, way);
}

bool visible_through(const Space& space, const ShadowQuery& query) {
  const Portal& portal = space.portals.portals()[query.portal];
  const Rigid* motion = portal.motion();
  if (!motion) return false;
  const Stretch unfolded = stretch(query.from, query.to);
  const auto met =
      Obstacles(space.surfaces, space.portals).first(unfolded.ray, unfolded.length, {query.guard});
  if (!met || met->object != query.portal ||
      (met->kind != Encounter::Kind::portal_front &&
       met->kind != Encounter::Kind::portal_through_back) ||
      meets_horizon(space, {unfolded.ray, met->distance}))
    return false;
  const Vec3d exit = motion->move(unfolded.ray.at(met->distance));
  const Stretch beyond = stretch(exit, motion->move(query.to));
  return visible_directly(space, beyond,
                          space.leaving_portal(portal.pair, exit, beyond.ray.direction));
}

}  // namespace

bool visible(const Space& space, const ShadowQuery& query) {
  if (query.portal != no_portal) return visible_through(space, query);
  return visible_directly(space, stretch(query.from, query.to), query.guard);
}

}  // namespace portalens
