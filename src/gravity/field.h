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
#include "gravity/law.h"
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

/// Field of one scene with one coupling. Borrows the masses, their tree and the coupling.
/// @tparam W  the `Weighing` of the law
template <class C, class W>
class Field {
 public:
  /// @param weight  the law's `uniform_weight`
  Field(std::span<const Mass> masses, const MassTree& tree, const C& coupling, double c,
        double weight)
      : masses_(masses), tree_(tree), coupling_(coupling), per_gm_(weight / (c * c)) {}

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
    if constexpr (W::uniform) {
      Bending sum = direct(x, t, frozen, 1.0);
      if (frozen.distance_to_support == 0.0) add(coupling_.pull(x, frozen.anchor), 1.0, sum);
      return sum;
    } else {
      const bool looks_through = frozen.distance_to_support == 0.0;
      const Pull through = looks_through ? coupling_.pull(x, frozen.anchor) : Pull{};
      const double w = potential(x, frozen, through), weight = W::weight(w);
      Bending sum = direct(x, t, frozen, weight);
      if (looks_through) add(through, weight, sum);
      sum.sinking = sinks(sum, t) ? 1.0 : 0.0;
      // The weight changes, too: ∇h = h' ∇w.
      const double square = dot(sum.acceleration, sum.acceleration) / (weight * weight);
      add_gradient(sum, std::fabs(W::weight_slope(w)) * square);
      return sum;
    }
  }

  /// What comes through portals is of the acceleration of `bending`.
  [[nodiscard]] Vec3d through_portals(Vec3d x, const Surroundings& frozen) const {
    if (frozen.distance_to_support != 0.0) return {};
    const Pull through = coupling_.pull(x, frozen.anchor);
    double weight = per_gm_;
    if constexpr (!W::uniform) weight *= W::weight(potential(x, frozen, through));
    return through.acceleration * weight;
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

  [[nodiscard]] static bool within(const Mass& mass, Vec3d x) { return mass.reaches(x); }

 private:
  /// w, of which a law's weight follows.
  [[nodiscard]] double potential(Vec3d x, const Surroundings& frozen, const Pull& through) const {
    double w = through.potential * per_gm_;
    for (const std::uint32_t i : frozen.inside) w += masses_[i].potential(x) * per_gm_;
    return w;
  }

  [[nodiscard]] Bending direct(Vec3d x, Vec3d t, const Surroundings& frozen, double weight) const {
    Bending sum;
    for (const std::uint32_t i : frozen.inside) {
      const Mass& mass = masses_[i];
      const Vec3d to_mass = mass.center - x;
      const double q = dot(to_mass, to_mass) + mass.core * mass.core;
      const double m = mass.gm * per_gm_ * weight;
      add_bending(sum, to_mass, q, dot(to_mass, t), m, m * m);
    }
    return sum;
  }

  void add(const Pull& through, double weight, Bending& sum) const {
    const double per_gm = per_gm_ * weight;
    sum.acceleration += through.acceleration * per_gm;
    sum.stiffness += through.stiffness * per_gm * distant_weight;
    sum.nearness += through.nearness;
    add_gradient(sum, through.gradient * per_gm);
  }

  std::span<const Mass> masses_;
  const MassTree& tree_;
  const C& coupling_;
  double per_gm_;  ///< 1/c², times the weight of a uniform law
};

}  // namespace portalens
