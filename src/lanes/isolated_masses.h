/// \file
/// The masses of a space that nothing but themselves can disturb: photons cross their influence by
/// table.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "gravity/crossing_table.h"
#include "photon/path_record.h"
#include "photon/step.h"

namespace portalens {

struct Mass;
struct Space;

struct IsolatedMass {
  std::uint32_t mass;  ///< index into the masses of the space
  std::size_t table;
};

struct IsolatedMasses {
  std::vector<IsolatedMass> masses;  ///< ascending
  std::vector<CrossingTable> tables;
};

/// Those without a core and with a horizon that no surface, no portal, nothing that comes through
/// one and no other mass touches within their finite influence, and no viewpoint; and for which a
/// table's errors stay below a tenth of the tolerance in radians, and below the tolerance as a
/// share of the influence's radius.
/// @param graze  paths that run through less of an influence may be left as they are
/// @param most  no more are given
[[nodiscard]] IsolatedMasses isolated_masses(const Space& space, double graze, std::size_t most);

/// Writes down the path of a photon through the influence of a mass.
/// @param left  where it left it, or met the horizon
/// @param length, turning  of its path until there
void note_crossing(const Mass& mass, const CrossingTable& table, const State& left, double length,
                   double turning, PathRecord& record);

}  // namespace portalens
