/// \file
/// Which of many masses act or absorb near a place, or along a ray.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/box_tree.h"
#include "gravity/mass.h"

namespace portalens {

/// The spheres in which masses act or absorb, in a tree of boxes if they are many. What it gives
/// is never too little, so whoever decides on each himself gets the bits that asking all would
/// give. Immutable, safe from any thread.
class MassTree {
 public:
  /// @throws WorkError if memory runs out
  explicit MassTree(std::span<const Mass> masses);

  /// So few that to hold them all costs less than to choose among them: then all are given always.
  [[nodiscard]] bool few() const { return !tree_; }
  /// Indices of all masses, ascending.
  [[nodiscard]] std::span<const std::uint32_t> every() const { return every_; }
  /// Half the mean radius of finite influences; 0 if there is none.
  [[nodiscard]] double usual() const { return usual_; }
  /// Those with a horizon that is no smaller than their influence, ascending.
  [[nodiscard]] std::span<const std::uint32_t> bare_horizons() const { return bare_horizons_; }

  /// The masses whose spheres meet the ball about `x`, ascending; with few, all.
  void around(Vec3d x, double radius, std::vector<std::uint32_t>& out) const;

  /// Distance along the ray at which a mass's influence first acts, 0 inside, or infinity.
  [[nodiscard]] double entry(const Ray& ray) const;

 private:
  struct Sphere {
    Vec3d center;
    double influence;
    double reach;  ///< of influence and horizon
  };
  std::vector<Sphere> spheres_;  ///< of all masses, close together
  std::vector<std::uint32_t> every_, bare_horizons_;
  std::vector<std::uint32_t> in_tree_, beside_;  ///< what the tree's items are; too large for it
  double usual_ = 0.0;
  std::optional<BoxTree> tree_;
};

}  // namespace portalens
