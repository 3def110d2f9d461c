#include "lanes/planned_space.h"

#include <utility>

namespace portalens {

PlannedSpace::PlannedSpace(Physics the_physics, std::uint32_t crossings, std::vector<Shape> shapes,
                           std::vector<Portal> the_portals, std::vector<Mass> the_masses,
                           std::optional<Vec3d> the_viewpoint)
    : Space(std::move(the_physics), crossings, std::move(shapes), std::move(the_portals),
            std::move(the_masses), the_viewpoint) {
  LaneChoice choice = plan_lanes(*this);
  lanes = std::move(choice.plan);
  no_lanes_because = std::move(choice.refusal);
}

}  // namespace portalens
