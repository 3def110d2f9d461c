#include "lanes/planned_space.h"

#include <utility>

namespace portalens {

PlannedSpace::PlannedSpace(Space space) : Space(std::move(space)) {
  LaneChoice choice = plan_lanes(*this);
  lanes = std::move(choice.plan);
  no_lanes_because = std::move(choice.refusal);
}

}  // namespace portalens
