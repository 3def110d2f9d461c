#include "photon/physics.h"

#include "gravity/coupling.h"
#include "gravity/law.h"
#include "photon/integrator.h"

namespace portalens {
namespace {

constexpr std::int64_t max_allowed_steps = 1'000'000'000;
constexpr std::int64_t max_depth = 16;
constexpr std::int64_t max_resolution = 1024;

}  // namespace

Physics Physics::from(Parameters& parameters) {
  Physics physics;
  physics.G = parameters.number("G", non_negative, physics.G);
  physics.c = parameters.number("c", {1e-9, 1e12}, physics.c);
  physics.min_force = parameters.number("min_force", non_negative, physics.min_force);
  physics.law = parameters.choice("law", law_names(), physics.law);
  physics.integrator = parameters.choice("integrator", Integrators::names, physics.integrator);
  physics.tolerance = parameters.number("tolerance", {1e-14, 1.0}, physics.tolerance);
  physics.step = parameters.number("step", positive, physics.step);
  physics.max_steps = parameters.integer("max_steps", 1, max_allowed_steps, physics.max_steps);
  physics.max_length = parameters.number("max_length", positive, physics.max_length);
  physics.max_turning = parameters.number("max_turning", positive, physics.max_turning);
  physics.portal_gravity =
      parameters.choice("portal_gravity", coupling_names(), physics.portal_gravity);
  physics.portal_gravity_depth =
      parameters.integer("portal_gravity_depth", 0, max_depth, physics.portal_gravity_depth);
  physics.graviton_resolution =
      parameters.integer("graviton_resolution", 2, max_resolution, physics.graviton_resolution);
  return physics;
}

}  // namespace portalens
