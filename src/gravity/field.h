/// \file
/// The whole acceleration of a photon: every mass directly, and what comes through portals.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "geometry/ray.h"
#include "gravity/attraction.h"
#include "gravity/coupling.h"
#include "gravity/mass.h"
#include "gravity/mass_tree.h"

namespace portalens {

/// The decisions that stay frozen over a step: which influences hold, and how portals act.
struct Surroundings {
  Vec3d anchor;
  std::vector<std::uint32_t> inside;  ///< masses in whose influence the anchor lies, ascending
  std::uint64_t signature = 0;        ///< of the coupling
  double distance_to_support = 0.0;   ///< distance within which the coupling stays silent

  [[nodiscard]] bool silent() const { return inside.empty() && distance_to_support > 0.0; }
};

/// g / c² at a point, and the sums from which a step is chosen and judged.
struct Bending {
  Vec3d acceleration;      ///< 1/length: dt/ds before its part along t is removed
  double stiffness = 0.0;  ///< Σ w m / d⁵ with w = path_weight, 1/length⁴
  double nearness = 0.0;   ///< Σ v / d⁴ with v = approach_weight, 1/length⁴
  double gradient = 0.0;   ///< Σ 2 m / d³, of the acceleration, 1/length²
};

/// Field of one scene with one coupling. Borrows the masses, their tree and the coupling.
template <class C>
class Field {
 public:
  Field(std::span<const Mass> masses, const MassTree& tree, const C& coupling, double c)
      : masses_(masses), tree_(tree), coupling_(coupling), inverse_c2_(1.0 / (c * c)) {}

  [[nodiscard]] double inverse_c2() const { return inverse_c2_; }

  /// @param near  the masses that may act there, ascending
  void surround(Vec3d anchor, std::span<const std::uint32_t> near, Surroundings& out) const {
    out.anchor = anchor;
    out.inside.clear();
    for (const std::uint32_t i : near)
      if (within(masses_[i], anchor)) out.inside.push_back(i);
    out.distance_to_support = coupling_.distance_to_support(anchor);
    out.signature = coupling_.signature(anchor);
  }

  /// Whether anything acts at a place.
  [[nodiscard]] bool acts(Vec3d x, std::span<const std::uint32_t> near) const {
    for (const std::uint32_t i : near)
      if (within(masses_[i], x)) return true;
    return coupling_.distance_to_support(x) == 0.0;
  }

  /// @param t  direction of the path, a unit vector: steps depend on it, the acceleration doesn't
  /// @pre x is not exactly at a mass without a core
  [[nodiscard]] Bending bending(Vec3d x, Vec3d t, const Surroundings& frozen) const {
    Bending sum;
    for (std::uint32_t i : frozen.inside) {
      const Mass& mass = masses_[i];
      const Vec3d to_mass = mass.center - x;
      const double q = dot(to_mass, to_mass) + mass.core * mass.core;
      const double inverse2 = 1.0 / q;
      const double inverse = std::sqrt(inverse2);
      const double pull = mass.gm * inverse_c2_ * inverse2 * inverse;
      sum.acceleration += to_mass * pull;
      const double along = dot(to_mass, t), m = mass.gm * inverse_c2_;
      sum.stiffness += pull * inverse2 * path_weight(m * m, q - along * along);
      sum.nearness += inverse2 * inverse2 * approach_weight(along * inverse);
      sum.gradient += 2.0 * pull;
    }
    if (frozen.distance_to_support == 0.0) {
      const Pull through = coupling_.pull(x, frozen.anchor);
      sum.acceleration += through.acceleration * inverse_c2_;
      sum.stiffness += through.stiffness * inverse_c2_ * distant_weight;
      sum.nearness += through.nearness;
      sum.gradient += through.gradient * inverse_c2_;
    }
    return sum;
  }

  [[nodiscard]] std::uint64_t signature(Vec3d x) const { return coupling_.signature(x); }

  /// A lower bound of the distance to where the coupling begins or ends to act; infinite if it
  /// doesn't tell.
  [[nodiscard]] double distance_to_discontinuity(Vec3d x) const {
    if constexpr (requires { coupling_.distance_to_discontinuity(x); })
      return coupling_.distance_to_discontinuity(x);
    else
      return std::numeric_limits<double>::infinity();
  }

  /// Distance along the ray at which a mass's influence or the coupling first acts, or infinity.
  [[nodiscard]] double free_flight(const Ray& ray, double resolution, double extent) const {
    const double least = tree_.entry(ray);
    double s = 0.0;
    while (s < least) {
      const double distance_to_support = coupling_.distance_to_support(ray.at(s));
      if (std::isinf(distance_to_support) || s > extent) return least;
      if (distance_to_support <= resolution) return s;
      s += distance_to_support;
    }
    return least;
  }

  [[nodiscard]] static bool within(const Mass& mass, Vec3d x) {
    const Vec3d to = mass.center - x;
    return dot(to, to) < mass.influence * mass.influence;
  }

 private:
  std::span<const Mass> masses_;
  const MassTree& tree_;
  const C& coupling_;
  double inverse_c2_;
};

}  // namespace portalens
