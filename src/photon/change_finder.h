/// \file
/// Where, along a step, what acts on a photon changes.
#pragma once

#include <cmath>
#include <optional>

#include "gravity/field.h"
#include "photon/curve.h"
#include "photon/space.h"
#include "photon/vicinity.h"

namespace portalens {

/// Compares what acts along a step with what acted at its start. Borrows all that it is made of.
template <class C, class W>
class ChangeFinder {
 public:
  /// @param vicinity  covers every step that is looked along
  /// @param surroundings  of its start
  ChangeFinder(const Space& space, const Field<C, W>& field, const Vicinity& vicinity,
               const Surroundings& surroundings)
      : space_(space), field_(field), vicinity_(vicinity), surroundings_(surroundings) {}

  /// Arc length just past the first place where the surroundings change, to within `margin`, or
  /// nothing.
  [[nodiscard]] std::optional<double> first_on(const Curve& curve, double margin) const {
    const double h = curve.length();
    double good = 0.0, bad = h;
    bool changed = false;
    for (const double share : {0.25, 0.5, 0.75, 1.0}) {
      if (differs(curve.position(share * h))) {
        bad = share * h;
        changed = true;
        break;
      }
      good = share * h;
    }
    // Influences that are entered and left, or left and entered, between two samples.
    const double grazed = grazed_influence(curve, bad, margin);
    if (grazed < bad) {
      changed = true;
      bad = grazed;
      good = 0.0;
    }
    if (!changed) return std::nullopt;
    while (bad - good > margin) {
      const double middle = 0.5 * (good + bad);
      if (middle <= good || middle >= bad) break;
      (differs(curve.position(middle)) ? bad : good) = middle;
    }
    return bad;
  }

 private:
  [[nodiscard]] bool differs(Vec3d x) const {
    std::size_t next = 0;
    for (const std::uint32_t i : vicinity_.near()) {
      const bool was = next < surroundings_.inside.size() && surroundings_.inside[next] == i;
      if (was) ++next;
      if (was != Field<C, W>::within(space_.masses[i], x)) return true;
    }
    return (std::isfinite(surroundings_.distance_to_support)) &&
           field_.signature(x) != surroundings_.signature;
  }

  /// Arc length of a place before `end` within an influence that the curve only grazes, or out of
  /// one that it leaves and enters again; or `end`.
  [[nodiscard]] double grazed_influence(const Curve& curve, double end, double margin) const {
    double first = end;
    const Vec3d a = curve.position(0.0), b = curve.position(end);
    for (const std::uint32_t i : vicinity_.near()) {
      const Mass& mass = space_.masses[i];
      if (std::isinf(mass.influence)) continue;
      const bool within = Field<C, W>::within(mass, a);
      // Over the curve the distance changes by no more than its length.
      const double both = length(mass.center - a) + length(mass.center - b);
      if (within ? both + end < 2.0 * mass.influence : both - end > 2.0 * mass.influence) continue;
      const double s = turning_place(curve, mass.center, end, within ? 1.0 : -1.0);
      if (s < first && Field<C, W>::within(mass, curve.position(s)) != within) first = s;
    }
    return grazed_coupling(curve, first, margin);
  }

  /// Arc length where the distance from a place ceases to grow (`side` 1) or to fall (-1), if it
  /// does before `end`; or `end`. To within what matters: there the distance changes least.
  [[nodiscard]] static double turning_place(const Curve& curve, Vec3d center, double end,
                                            double side) {
    const auto goes_on = [&](double s) {
      return dot(curve.position(s) - center, curve.direction(s)) * side > 0.0;
    };
    if (!goes_on(0.0) || goes_on(end)) return end;
    double low = 0.0, high = end;
    for (int k = 0; k < 16; ++k) {
      const double middle = 0.5 * (low + high);
      (goes_on(middle) ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

  /// The same for the coupling, before `end`. None of its boundaries is nearer than
  /// `distance_to_discontinuity`, so the next place to look at is that far on.
  [[nodiscard]] double grazed_coupling(const Curve& curve, double end, double margin) const {
    if (std::isinf(surroundings_.distance_to_support)) return end;
    double least = std::fmax(margin, 1e-3 * curve.length());
    double s = 0.0;
    while (true) {
      const double distance_to_discontinuity = field_.distance_to_discontinuity(curve.position(s));
      s += std::fmax(distance_to_discontinuity, least);
      if (s >= end) return end;
      if (differs(curve.position(s))) return s;
      // A path along a boundary would be looked at a thousand times.
      if (distance_to_discontinuity < least) least *= 1.1;
    }
  }

  const Space& space_;
  const Field<C, W>& field_;
  const Vicinity& vicinity_;
  const Surroundings& surroundings_;
};

}  // namespace portalens
