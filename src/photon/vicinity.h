/// \file
/// The masses that matter about a place, out of many.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "geometry/ray.h"
#include "gravity/mass.h"
#include "math/vec3.h"

namespace portalens {

/// Holds the masses whose influence or horizon meets a ball, and moves the ball along with a
/// photon: so a step asks a few masses, not all. With few masses it always holds them all. Borrows
/// them.
class Vicinity {
 public:
  explicit Vicinity(std::span<const Mass> masses);

  /// Makes sure that it holds all that acts or absorbs within `reach` of `x`.
  void cover(Vec3d x, double reach) {
    if (all_) return;
    const bool small = near_.radius <= 32.0 * std::fmax(usual_, reach);
    if (!small || !near_.holds(x, reach)) gather(x, reach);
  }
  /// Indices of masses, ascending: all that were asked for, and some others.
  [[nodiscard]] std::span<const std::uint32_t> near() const { return all_ ? every_ : near_.held; }
  /// The same within a larger ball; no other acts along a ray before `end_of_around`.
  [[nodiscard]] std::span<const std::uint32_t> around() const {
    return all_ ? every_ : around_.held;
  }
  [[nodiscard]] double end_of_around(const Ray& ray) const {
    if (all_) return std::numeric_limits<double>::infinity();
    const Vec3d from = ray.origin - around_.center;
    const double along = dot(from, ray.direction);
    const double inside = around_.radius * around_.radius - dot(from, from);
    return inside > 0.0 ? std::sqrt(along * along + inside) - along : 0.0;
  }

 private:
  /// The masses that meet a ball.
  struct Ball {
    Vec3d center;
    double radius = -1.0;
    std::vector<std::uint32_t> held;

    [[nodiscard]] bool holds(Vec3d x, double reach) const {
      return length(x - center) + reach <= radius;
    }
  };
  void gather(Vec3d x, double reach);
  void fill(Ball& ball, Vec3d x, double radius, std::span<const std::uint32_t> from) const;

  /// Where a mass acts or absorbs.
  struct Reach {
    Vec3d center;
    double radius;
  };

  std::vector<Reach> reaches_;  ///< of all masses
  std::vector<std::uint32_t> every_;
  Ball around_, near_;  ///< the larger one saves asking every mass
  double usual_ = 0.0;  ///< radius beyond what is asked for
  bool all_;            ///< they are held
};

}  // namespace portalens
