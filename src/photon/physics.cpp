#include "photon/physics.h"

#include <algorithm>
#include <array>
#include <vector>

#include "core/words.h"
#include "gravity/coupling.h"

namespace portalens {
namespace {

constexpr std::array<std::string_view, 3> integrators = {"euler", "rk4", "adaptive"};
constexpr std::array<std::string_view, 5> couplings = {"none", "closest-point", "shortest-path",
                                                       "graviton-map", "portal-mass"};
constexpr std::int64_t most_steps = 1'000'000'000;
constexpr std::int64_t most_depth = 16;
constexpr std::int64_t most_resolution = 1024;

/// One of the couplings of physics.md, sec. 5, if this build has it.
std::string coupling_from(Parameters& parameters, const std::string& fallback) {
  const std::string asked = parameters.choice("portal_gravity", couplings, fallback);
  const std::vector<std::string_view> built = coupling_names();
  if (std::find(built.begin(), built.end(), asked) != built.end()) return asked;
  parameters.fault("portal_gravity", "portal gravity " + in_quotes(asked) + " is not built yet",
                   "known are " + listed({built.begin(), built.end()}));
  return fallback;
}

}  // namespace

Physics Physics::from(Parameters& parameters) {
  Physics physics;
  physics.G = parameters.number("G", non_negative, physics.G);
  physics.c = parameters.number("c", {1e-9, 1e12}, physics.c);
  physics.min_force = parameters.number("min_force", non_negative, physics.min_force);
  physics.integrator = parameters.choice("integrator", integrators, physics.integrator);
  physics.tolerance = parameters.number("tolerance", {1e-14, 1.0}, physics.tolerance);
  physics.step = parameters.number("step", positive, physics.step);
  physics.max_steps = parameters.integer("max_steps", 1, most_steps, physics.max_steps);
  physics.max_length = parameters.number("max_length", positive, physics.max_length);
  physics.max_turning = parameters.number("max_turning", positive, physics.max_turning);
  physics.portal_gravity = coupling_from(parameters, physics.portal_gravity);
  physics.portal_gravity_depth =
      parameters.integer("portal_gravity_depth", 0, most_depth, physics.portal_gravity_depth);
  physics.graviton_resolution =
      parameters.integer("graviton_resolution", 2, most_resolution, physics.graviton_resolution);
  return physics;
}

}  // namespace portalens
