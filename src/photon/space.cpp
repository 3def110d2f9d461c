#include "photon/space.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "photon/lane_plan.h"

namespace portalens {

Space::Space(Physics the_physics, std::uint32_t crossings, std::vector<Shape> shapes,
             std::vector<Portal> the_portals, std::vector<Mass> the_masses,
             std::optional<Vec3d> the_viewpoint)
    : physics(std::move(the_physics)),
      max_crossings(crossings),
      surfaces(std::move(shapes)),
      portals(std::move(the_portals)),
      masses(std::move(the_masses)),
      mass_tree(masses),
      coupling(
          make_coupling(physics.portal_gravity, {portals.portals(), masses, physics.min_force,
                                                 static_cast<int>(physics.portal_gravity_depth),
                                                 static_cast<int>(physics.graviton_resolution),
                                                 physics.tolerance * physics.c * physics.c})),
      viewpoint(the_viewpoint) {
  Box box = surfaces.bounds();
  for (const Portal& portal : portals.portals())
    for (const Vec3d& vertex : portal.vertices) box.add(vertex);
  for (const Mass& mass : masses) {
    unbounded = unbounded || (std::isinf(mass.influence) && mass.gm > 0.0);
    const double reach = std::isinf(mass.influence) ? mass.schwarzschild : mass.influence;
    box.add(mass.center - Vec3d{reach, reach, reach});
    box.add(mass.center + Vec3d{reach, reach, reach});
  }
  if (box.diagonal() > 0.0) extent = box.diagonal();
  LaneChoice choice = plan_lanes(*this);
  lanes = std::move(choice.plan);
  no_lanes_because = std::move(choice.refusal);
}

Space::Space(Space&&) noexcept = default;
Space::~Space() = default;

}  // namespace portalens
