#include "lanes/coupling_layout.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/words.h"
#include "gravity/bound_light.h"
#include "lanes/face_plan.h"
#include "lanes/narrow.h"
#include "photon/space.h"

namespace portalens {

double light_sphere(const Space& space, double gm) {
  return space.medium.light_sphere * gravitational_radius(gm, space.physics.c);
}

void CouplingLayout::mass(Vec3d center, double gm, double core2, double influence) {
  const auto m = static_cast<float>(space_.medium.uniform_weight() *
                                    gravitational_radius(gm, space_.physics.c));
  const auto square = static_cast<float>(core2), reach = static_cast<float>(influence);
  masses_.push_back({narrow(center - plan_.center), m, square, reach, reach * reach, -1.0f, 1.0f,
                     bare2_of(m, square)});
}

std::string add_coupling(const Space& space, LanePlan& plan, std::vector<LaneMass>& masses) {
  CouplingLayout layout(space, plan);
  const auto tell = [&](const auto& coupling) -> std::string {
    if constexpr (requires { coupling.lay_out(layout); })
      return coupling.lay_out(layout);
    else
      return fmt::format("lanes do not know the coupling {}",
                         in_quotes(space.physics.portal_gravity));
  };
  std::string why = std::visit(tell, space.coupling);
  masses = layout.masses();
  return why;
}

double strongest_onset(const Space& space) {
  double strongest = space.physics.min_force;
  if (!std::visit([](const auto& coupling) { return coupling.asks_motion; }, space.coupling))
    return strongest;
  for (const Portal& mouth : space.mouths)
    for (const Mass& mass : space.masses) {
      const double distance = felt_from(space.mouths[mouth.pair], mass);
      if (distance < mass.influence)
        strongest = std::max(strongest, mass.gm / (distance * distance));
    }
  return strongest;
}

}  // namespace portalens
