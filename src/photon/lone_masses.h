/// \file
/// The masses of a space that nothing but themselves can disturb: photons cross their influence by
/// table.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "gravity/crossing_table.h"
#include "photon/step.h"
#include "photon/trail.h"

namespace portalens {

struct Mass;
struct Space;

struct LoneMass {
  std::uint32_t mass;  ///< index into the masses of the space
  std::size_t table;
};

struct LoneMasses {
  std::vector<LoneMass> masses;  ///< ascending
  std::vector<CrossingTable> tables;
};

/// Those without a core and with a horizon that no surface, no portal, nothing that comes through
/// one and no other mass touches within their finite influence, and no viewpoint; and for which a
/// table's errors stay below a tenth of the tolerance in radians, and below the tolerance as a
/// share of the influence's radius.
/// @param graze  ways that run through less of an influence may be left as they are
/// @param most  no more are given
[[nodiscard]] LoneMasses lone_masses(const Space& space, double graze, std::size_t most);

/// Writes down the way of a photon through the influence of a mass.
/// @param left  where it left it, or met the horizon
/// @param length, turning  of its way until there
void note_crossing(const Mass& mass, const CrossingTable& table, const State& left, double length,
                   double turning, Trail& trail);

}  // namespace portalens
