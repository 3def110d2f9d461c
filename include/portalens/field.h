/// \file
/// The field that bends light: by how much a photon is accelerated at a place, and by what.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "portalens/types.h"
#include "portalens/world.h"

namespace portalens::api {

/// What one mass adds directly, or what comes one way through portals.
struct FieldPart {
  std::string mass;                  ///< what pulls; empty if a way through portals is not to one
  std::vector<std::string> portals;  ///< entered one after the other; none: directly
  Vec3 acceleration;                 ///< length/time²
  double distance = 0.0;             ///< length of the way
};

/// The field at a place.
struct Field {
  Vec3 position;
  Vec3 acceleration;  ///< length/time²
  std::vector<FieldPart> parts;
};

/// The acceleration at each place, length/time², in their order.
/// @throws Error (asked) that names every place with a number that is not finite
[[nodiscard]] std::vector<Vec3> field(const World& world, std::span<const Vec3> places);

/// The field at one place, and what it consists of.
/// @throws Error (asked) if a number is not finite
[[nodiscard]] Field field_parts(const World& world, Vec3 place);

}  // namespace portalens::api
