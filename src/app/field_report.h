/// \file
/// The field at a point and what it consists of, for `portalens field --at`.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/json.h"
#include "gravity/pull_part.h"
#include "photon/space.h"

namespace portalens {

/// What one mass does directly.
struct DirectPart {
  std::uint32_t mass;
  Vec3d acceleration;
  double distance;
};

/// Accelerations in length/time².
struct FieldReport {
  Vec3d position, total;
  std::vector<DirectPart> direct;  ///< of masses within whose influence the point lies
  std::vector<PullPart> through;   ///< of the coupling
};

[[nodiscard]] FieldReport report_field(const Space& space, Vec3d x);

/// g at x, as photons feel it.
[[nodiscard]] Vec3d field_at(const Space& space, Vec3d x);

[[nodiscard]] Json field_json(const Space& space, const FieldReport& report);

/// The same for people: a line for each part.
[[nodiscard]] std::string field_text(const Space& space, const FieldReport& report);

}  // namespace portalens
