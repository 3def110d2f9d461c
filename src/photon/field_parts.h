/// \file
/// The field that bends light at a point, and what it consists of.
#pragma once

#include <cstdint>
#include <vector>

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
  double potential = 0.0;          ///< w, of which the law's weight h follows
  double weight = 1.0;             ///< h
  Vec3d pull;                      ///< what light feels: h times the total
  std::vector<DirectPart> direct;  ///< of masses within whose influence the point lies
  std::vector<PullPart> through;   ///< of the coupling
};

[[nodiscard]] FieldReport report_field(const Space& space, Vec3d x);

/// g at x, as photons feel it.
[[nodiscard]] Vec3d field_at(const Space& space, Vec3d x);

}  // namespace portalens
