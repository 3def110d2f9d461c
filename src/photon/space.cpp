#include "photon/space.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace portalens {
namespace {

std::vector<Opening> openings_of(const std::vector<Portal>& portals) {
  std::vector<Opening> openings;
  for (const Portal& portal : portals)
    openings.push_back({portal.vertices, portal.frame.normal, pieces_of(portal)});
  return openings;
}

}  // namespace

Space::Space(Physics the_physics, std::uint32_t crossings, std::vector<Shape> shapes,
             std::vector<Portal> the_portals, std::vector<Mass> the_masses,
             std::optional<Vec3d> the_viewpoint)
    : physics(std::move(the_physics)),
      law(make_law(physics.law)),
      medium(constants_of(law)),
      max_crossings(crossings),
      surfaces(std::move(shapes), openings_of(the_portals)),
      portals(std::move(the_portals), surfaces.flush(),
              static_cast<std::uint32_t>(surfaces.shapes().size())),
      mouths(one_sided(portals.portals())),
      masses(std::move(the_masses)),
      mass_tree(masses),
      coupling(make_coupling(
          physics.portal_gravity,
          {mouths, masses, physics.min_force, static_cast<int>(physics.portal_gravity_depth),
           static_cast<int>(physics.graviton_resolution),
           physics.tolerance * physics.c * physics.c})),
      viewpoint(the_viewpoint) {
  Box box = surfaces.bounds();
  for (const Portal& portal : portals.portals())
    for (const Vec3d& vertex : portal.vertices) box.add(vertex);
  for (const Mass& mass : masses) {
    unbounded = unbounded || (std::isinf(mass.influence) && mass.gm > 0.0);
    const double reach =
        std::isinf(mass.influence) ? schwarzschild_radius(mass.gm, physics.c) : mass.influence;
    box.add(mass.center - Vec3d{reach, reach, reach});
    box.add(mass.center + Vec3d{reach, reach, reach});
  }
  if (box.diagonal() > 0.0) extent = box.diagonal();
}

SelfIntersectionGuard Space::leaving_portal(std::uint32_t index, Vec3d position,
                                            Vec3d direction) const {
  const Portal& portal = portals.portals()[index];
  const double slope = dot(direction, portal.frame.normal);
  const auto shape_count = static_cast<std::uint32_t>(surfaces.shapes().size());
  return {shape_count + index, 0, slope < 0.0 ? -1.0 : 1.0,
          guard_reach(length(position) + portal.longest_edge, slope)};
}

}  // namespace portalens
