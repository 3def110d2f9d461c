/// \file
/// What the end of influences takes from the bending of light. equations.md, section 2.
#pragma once

#include <optional>

#include "render/trace.h"
#include "world/world.h"

namespace portalens {

/// The masses of a world as if no pull ended at a radius of influence (`min_force` 0), and nothing
/// else: photons are followed there once more.
class EndlessPull {
 public:
  explicit EndlessPull(const World& world);

  /// By how much more the photon would turn there, radians; below 0 where the pulls of several
  /// masses would undo each other. Told of photons that have escaped past no portal and no mirror;
  /// nothing of others, of those that would not escape there, and where no influence ends.
  [[nodiscard]] std::optional<double> missing_turning(const Trace& trace) const;

 private:
  std::optional<PlannedSpace> space_;  ///< none where no influence ends
};

}  // namespace portalens
