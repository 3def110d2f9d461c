/// \file
/// The list of laws by which masses bend light. equations.md, sec. 1 and 2.
///
/// Each law is a medium, ln n = F(w), of the sum w = Σ m/√(d² + a²) over the masses felt; so light
/// turns by h(w) = dF/dw times what Newton's pull over c² turns it by.
///
/// To add one: a header beside this one, and a word in `Law`. Each type has
///   static constexpr std::string_view name;     as `physics.law` spells it
///   static constexpr bool uniform;              h is the same everywhere: w need not be known
///   static constexpr bool bare_masses;          masses may have neither a horizon nor a core
///   template <class Real> static Real weight(Real w);
///       h, also of packs of lanes; finite for all w >= 0
///   template <class Real> static Real weight_slope(Real w);
///       dh/dw; of laws that are not uniform
///   static double log_index(double w);          F
///   static double clock(double w);              N: the rate of a clock at rest
///   static double horizon_radius(double m, double w);
///       where light ends about a mass with a horizon: its distance; w is that of all other masses
///       at its centre (0 of uniform laws)
/// It may have
///   static constexpr double greatest_potential;
///       light ends where the w of the masses that act directly comes to that. `horizon_radius` is
///       then only for what draws horizons or casts their shadows
/// Both engines follow a newcomer unasked: lanes where no portal acts, and few masses do
/// (lanes/limits.h).
#pragma once

#include <span>
#include <string_view>
#include <type_traits>
#include <variant>

#include "gravity/einstein_law.h"
#include "gravity/extreme_law.h"
#include "gravity/newton_law.h"
#include "gravity/schwarzschild_law.h"

namespace portalens {

struct Mass;

using Law = std::variant<NewtonLaw, EinsteinLaw, SchwarzschildLaw, ExtremeLaw>;

/// The names of all laws, in the order of the list.
[[nodiscard]] std::span<const std::string_view> law_names();

/// The law with that name.
/// @pre `name` is one of `law_names()`
[[nodiscard]] Law make_law(std::string_view name);

/// What of a law is the same at all places.
struct LawConstants {
  bool uniform = true;
  double far_weight = 1.0;          ///< h(0): far from all masses
  double greatest_potential = 0.0;  ///< infinite where horizons are balls
  bool bare_masses = true;
  /// At that many m from one mass light circles it, and what comes nearer falls in: h(w) w = 1.
  double light_sphere = 1.0;

  /// By how much masses count for more than under the paper's law, where that is the same
  /// everywhere; 1 for other laws.
  [[nodiscard]] double uniform_weight() const { return uniform ? far_weight : 1.0; }
};
[[nodiscard]] LawConstants constants_of(const Law& law);

/// Sets where light ends about each mass.
/// @param c  speed of light
void set_horizons(const Law& law, std::span<Mass> masses, double c);

/// Stands for all uniform laws where light is followed: masses count `uniform_weight` times there.
struct UniformWeight {
  static constexpr bool uniform = true;
};
template <class L>
using Weighing = std::conditional_t<L::uniform, UniformWeight, L>;

/// Calls `f` with the `Weighing` of a law.
template <class F>
decltype(auto) visit_weighing(const Law& law, const F& f) {
  return std::visit(
      [&](const auto& one) { return f(Weighing<std::remove_cvref_t<decltype(one)>>{}); }, law);
}

}  // namespace portalens
