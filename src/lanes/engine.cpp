#include "lanes/engine.h"

#include <cassert>

#include "lanes/driver.h"
#include "lanes/instruction_sets.h"
#include "photon/advance.h"
#include "photon/integrator.h"

namespace portalens {
namespace {

Integrator integrator_of(const Physics& physics) {
  const auto made = Integrators::make(physics.integrator, {physics.step, physics.tolerance});
  assert(made);
  return *made;
}

/// Calls `f` with the scalar engine of a space.
template <class F>
void with_tracer(const Space& space, const F& f) {
  visit_weighing(space.law, [&](auto weighing) {
    std::visit([&](const auto& integrator,
                   const auto& coupling) { f(Tracer(space, integrator, coupling, weighing)); },
               integrator_of(space.physics), space.coupling);
  });
}

}  // namespace

bool takes_lanes(const PlannedSpace& space, Engine engine) {
  return engine == Engine::automatic && space.lanes && lane_engine().step;
}

std::string why_no_lanes(const PlannedSpace& space, Engine engine) {
  if (takes_lanes(space, engine)) return "";
  if (engine == Engine::scalar) return "it is asked for (--engine scalar)";
  if (!space.lanes) return space.no_lanes_because;
  return why_no_lane_engine();
}

void advance(const PlannedSpace& space, std::span<const Photon> photons,
             std::span<Arrival> arrivals, Engine engine) {
  assert(photons.size() == arrivals.size());
  if (takes_lanes(space, engine)) {
    advance_in_lanes(space, *space.lanes, lane_engine().step, photons, arrivals);
    return;
  }
  with_tracer(space, [&](auto&& tracer) {
    for (std::size_t i = 0; i < photons.size(); ++i)
      arrivals[i] = tracer.advance(photons[i], nullptr);
  });
}

void advance_with_records(const PlannedSpace& space, std::span<const Photon> photons,
                          std::span<Arrival> arrivals, std::span<PathRecord> records) {
  assert(takes_lanes(space, Engine::automatic));
  assert(photons.size() == arrivals.size() && records.size() <= photons.size());
  for (PathRecord& record : records) record.restart();
  advance_in_lanes(space, *space.lanes, lane_engine().step, photons, arrivals, records);
}

Arrival advance_recorded(const PlannedSpace& space, const Photon& photon, PathTrace& path_trace) {
  Arrival arrival;
  with_tracer(space, [&](auto&& tracer) { arrival = tracer.advance(photon, &path_trace); });
  return arrival;
}

}  // namespace portalens
