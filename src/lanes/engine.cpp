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

}  // namespace

bool takes_lanes(const PlannedSpace& space, Engine engine) {
  return engine == Engine::automatic && space.lanes && lane_engine().step;
}

std::string why_no_lanes(const PlannedSpace& space, Engine engine) {
  if (takes_lanes(space, engine)) return "";
  if (engine == Engine::scalar) return "it is asked for (--engine scalar)";
  if (!space.lanes) return space.no_lanes_because;
  return "this processor has not the instructions that lanes need (SSE 4.2)";
}

void advance(const PlannedSpace& space, std::span<const Photon> photons,
             std::span<Arrival> arrivals, Engine engine) {
  assert(photons.size() == arrivals.size());
  if (takes_lanes(space, engine)) {
    advance_in_lanes(space, *space.lanes, lane_engine().step, photons, arrivals);
    return;
  }
  std::visit(
      [&](const auto& integrator, const auto& coupling) {
        Tracer tracer(space, integrator, coupling);
        for (std::size_t i = 0; i < photons.size(); ++i)
          arrivals[i] = tracer.advance(photons[i], nullptr);
      },
      integrator_of(space.physics), space.coupling);
}

void advance_with_records(const PlannedSpace& space, std::span<const Photon> photons,
                          std::span<Arrival> arrivals, std::span<PathRecord> records) {
  assert(takes_lanes(space, Engine::automatic));
  assert(photons.size() == arrivals.size() && records.size() <= photons.size());
  for (PathRecord& record : records) record.restart();
  advance_in_lanes(space, *space.lanes, lane_engine().step, photons, arrivals, records);
}

Arrival advance_recorded(const PlannedSpace& space, const Photon& photon, PathTrace& path_trace) {
  return std::visit(
      [&](const auto& integrator, const auto& coupling) {
        return Tracer(space, integrator, coupling).advance(photon, &path_trace);
      },
      integrator_of(space.physics), space.coupling);
}

}  // namespace portalens
