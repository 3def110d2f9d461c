/// \file
/// The masses that matter about a place, out of many.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "gravity/mass_tree.h"
#include "math/vec3.h"

namespace portalens {

/// Holds the masses whose influence or horizon meets a ball, and moves the ball along with a
/// photon: so a step asks a few masses, not all. With few masses it always holds them all. Borrows
/// the tree.
class Vicinity {
 public:
  explicit Vicinity(const MassTree& masses) : masses_(masses) {}

  /// Makes sure that it holds all that acts or absorbs within `reach` of `x`.
  void cover(Vec3d x, double reach) {
    if (masses_.few()) return;
    const bool small = radius_ <= 32.0 * std::fmax(masses_.usual(), reach);
    if (!small || !(length(x - center_) + reach <= radius_)) gather(x, reach);
  }
  /// Indices of masses, ascending: all that were asked for, and some others.
  [[nodiscard]] std::span<const std::uint32_t> near() const {
    return masses_.few() ? masses_.every() : held_;
  }

 private:
  void gather(Vec3d x, double reach) {
    center_ = x;
    radius_ = reach + masses_.usual();
    masses_.around(x, radius_, held_);
  }

  const MassTree& masses_;
  Vec3d center_;
  double radius_ = -1.0;
  std::vector<std::uint32_t> held_;
};

}  // namespace portalens
