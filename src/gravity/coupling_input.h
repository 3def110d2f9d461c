/// \file
/// What every coupling is made from, and what it answers.
#pragma once

#include <cmath>
#include <span>

#include "gravity/attraction.h"
#include "gravity/mass.h"
#include "gravity/pull_part.h"
#include "portal/portal.h"

namespace portalens {

struct CouplingInput {
  std::span<const Portal> portals;  ///< all one-sided; each is a motion where the type asks for one
  std::span<const Mass> masses;     ///< massive portals among them
  double min_force = 0.01;          ///< f, length/time²
  int depth = 1;                    ///< portals in a row, >= 0; 0 = none
  int graviton_resolution = 32;     ///< nodes along a portal's longer side, >= 2
  double unfelt = 0.0;  ///< c² times a turning that does not matter, (length/time)²; 0: all do
};

/// What a coupling will cost, in pulls of one mass or of like size; an estimate from above.
struct CouplingCost {
  double each_call = 0.0;    ///< of `pull`
  double preparation = 0.0;  ///< once, to make it
};

/// A scene whose coupling would cost more is refused; the remedy is a smaller depth.
inline constexpr CouplingCost coupling_budget{2e5, 1e8};

/// The number of chains of exactly `size` portals, none going straight back through a pair.
[[nodiscard]] inline double chain_count(const CouplingInput& input, int size) {
  const auto portals = static_cast<double>(input.portals.size());
  return portals == 0.0 ? 0.0 : portals * std::pow(portals - 1.0, size - 1);
}

/// An acceleration, and how sharply it varies, from which the step is chosen: the sums over its
/// sources of G M / d⁵ and of 1 / d⁴ (d with the core; any other length over which the field varies
/// counts as a d), and of 2 G M / d³ of what changes as the photon is displaced. Of the sum of G M
/// / d follows how much a law lets all of it count.
struct Pull {
  Vec3d acceleration;
  double stiffness = 0.0;
  double nearness = 0.0;
  double gradient = 0.0;
  double potential = 0.0;  ///< Σ G M / d

  Pull& operator+=(const Pull& other) {
    acceleration += other.acceleration;
    stiffness += other.stiffness;
    nearness += other.nearness;
    gradient += other.gradient;
    potential += other.potential;
    return *this;
  }

  /// What comes from a point of a face that runs at that pace: a vertex stays where it is; along a
  /// curved rim the point may be quick, and soon be elsewhere.
  void lead(Pace pace) {
    gradient *= pace.speed;
    stiffness += swing_weight * gradient / (pace.pivot * pace.pivot);
  }
};

}  // namespace portalens
