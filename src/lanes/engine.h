/// \file
/// Advancing photons until each has arrived somewhere: the interface of all engines.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "lanes/planned_space.h"
#include "photon/path_record.h"
#include "photon/path_trace.h"
#include "photon/photon.h"

namespace portalens {

/// Which engine advances. `automatic` takes the lanes where the space and the processor allow it
/// (lanes/plan.h) and the scalar engine elsewhere.
enum class Engine : std::uint8_t { automatic, scalar };

/// Advances photons to their first surface. `arrivals[i]` answers `photons[i]`, whatever the order
/// of work inside; no photon's answer depends on another's.
/// @pre photons.size() == arrivals.size(), directions are unit vectors
void advance(const PlannedSpace& space, std::span<const Photon> photons,
             std::span<Arrival> arrivals, Engine engine = Engine::automatic);

/// Whether that engine advances photons of the space in lanes.
[[nodiscard]] bool takes_lanes(const PlannedSpace& space, Engine engine);
/// Why it does not, as a `LaneChoice` says it; empty where it does.
[[nodiscard]] std::string why_no_lanes(const PlannedSpace& space, Engine engine);

/// Advances photons in lanes, and records the paths of the first of them.
/// @param records  of the first photons; what they held before is overwritten
/// @pre takes_lanes(space, Engine::automatic), records.size() <= photons.size()
void advance_with_records(const PlannedSpace& space, std::span<const Photon> photons,
                          std::span<Arrival> arrivals, std::span<PathRecord> records);

/// The same for one photon, with its path written down.
[[nodiscard]] Arrival advance_recorded(const PlannedSpace& space, const Photon& photon,
                                       PathTrace& path_trace);

}  // namespace portalens
