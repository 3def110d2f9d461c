/// \file
/// The list of couplings: ways in which gravity reaches through portals. physics.md, sec. 5.
///
/// To add one: a header beside this one, and a word in `Coupling`. Each type has
///   static constexpr std::string_view name;               as `physics.portal_gravity` spells it
///   explicit T(const CouplingInput&);
///   Pull pull(Vec3d x, Vec3d anchor) const;
///       what portals add to the acceleration at x (direct attraction is not part of it). Every
///       decision (which side, which edge is nearest, what is in reach) is taken at `anchor`, every
///       value at x: so the field stays smooth over a step whose decisions are frozen.
///   std::uint64_t signature(Vec3d x) const;
///       a hash of all decisions at x: where it changes, the field is not smooth
///   double quiet(Vec3d x) const;
///       a lower bound of the distance from x to where the coupling acts; 0 where it does, infinite
///       if it never does
/// and is immutable.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <variant>

#include "gravity/mass.h"
#include "portal/portal.h"

namespace portalens {

struct CouplingInput {
  std::span<const Portal> portals;
  std::span<const Mass> masses;  ///< massive portals among them
  double min_force = 0.01;
  int depth = 1;
  int graviton_resolution = 32;
};

/// An acceleration, and how sharply it varies, from which the step is chosen: the sums over its
/// sources of G M / d⁵ and of 1 / d⁴ (d with the core; any other length over which the field varies
/// counts as a d).
struct Pull {
  Vec3d acceleration;
  double stiffness = 0.0;
  double nearness = 0.0;
};

/// Gravity ignores portals.
class NoCoupling {
 public:
  static constexpr std::string_view name = "none";
  NoCoupling() = default;
  explicit NoCoupling(const CouplingInput&) {}
  [[nodiscard]] Pull pull(Vec3d, Vec3d) const { return {}; }
  [[nodiscard]] std::uint64_t signature(Vec3d) const { return 0; }
  [[nodiscard]] double quiet(Vec3d) const { return std::numeric_limits<double>::infinity(); }
};

using Coupling = std::variant<NoCoupling>;

}  // namespace portalens
