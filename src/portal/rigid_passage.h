/// \file
/// A rigid motion as what leads through a portal: Dunigan & Pianta, sec. 4; equations.md, sec. 4.
#pragma once

#include <optional>
#include <string_view>

#include "math/rigid.h"
#include "portal/passage_input.h"

namespace portalens {

/// The motion through A: (x, y, z) in A's frame becomes (-x, y, -z) in B's, half a turn about `up`.
[[nodiscard]] Rigid motion_through(const Frame& a, const Frame& b);

class RigidPassage {
 public:
  static constexpr std::string_view name = "rigid motion";

  RigidPassage() = default;  ///< leads nowhere else
  explicit RigidPassage(const Rigid& motion) : motion_(motion) {}
  /// Takes every pair.
  [[nodiscard]] static std::optional<RigidPassage> between(const PassageInput& input) {
    return RigidPassage(motion_through(input.from.frame, input.to.frame));
  }

  [[nodiscard]] Passed pass(Vec3d position, Vec3d direction) const {
    return {motion_.move(position), motion_.rotate(direction), 0.0};
  }
  [[nodiscard]] const Rigid* motion() const { return &motion_; }

 private:
  Rigid motion_;
};

}  // namespace portalens
