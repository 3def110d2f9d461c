/// \file
/// One photon for `portalens trace`, from its start to its fate, with mirrors on the way if asked.
#pragma once

#include <string>
#include <vector>

#include "app/json.h"
#include "photon/engine.h"
#include "world/world.h"

namespace portalens {

struct Trace {
  /// The mirrors on the way. Lengths, turnings and steps, here and at the end, count from the
  /// start.
  std::vector<Arrival> bounces;
  Arrival end;
  Journey journey;
};

/// Follows a photon to its end. The first `most_bounces` surfaces are taken for exact mirrors,
/// whatever their material; masses, portals and the end are as always.
/// @param direction  unit vector
[[nodiscard]] Trace trace_ray(const World& world, Vec3d position, Vec3d direction,
                              int most_bounces);

/// What the arrival met, as the scene names it; empty if nothing.
[[nodiscard]] std::string name_of_met(const World& world, const Arrival& arrival);

enum class PathOutput { omitted, included };

/// The fields of scene-format.md, section 3. `bounces` is there if any were asked for.
[[nodiscard]] Json trace_json(const World& world, const Trace& trace, int most_bounces,
                              PathOutput path);

/// The same for people: a line, one more for each bounce, and the path if it is included.
[[nodiscard]] std::string trace_text(const World& world, const Trace& trace, PathOutput path);

}  // namespace portalens
