/// \file
/// The list of integrators. To add one: a header beside this one, and a word in `Integrator`.
///
/// Each type has
///   static constexpr std::string_view name;      as `physics.integrator` spells it
///   static constexpr bool fixed_step;            true: steps of `length`, discontinuities ignored;
///                                                false: `propose`, `roughness`, `longest_after`,
///                                                `smooth` and `roughest` choose and judge steps,
///                                                as in `Radau`
///   static constexpr bool straight_pieces;       the path between two steps is a straight line
///   static T from(const IntegratorSettings&);
///   static StepResult step(acceleration, State, start_acceleration, h);
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "photon/euler.h"
#include "photon/radau.h"
#include "photon/rk4.h"

namespace portalens {

using Integrator = std::variant<Radau, Rk4, Euler>;

template <class Variant>
struct IntegratorList;

template <class... Types>
struct IntegratorList<std::variant<Types...>> {
  static constexpr std::array<std::string_view, sizeof...(Types)> names = {Types::name...};

  [[nodiscard]] static std::optional<std::variant<Types...>> make(
      std::string_view name, const IntegratorSettings& settings) {
    std::optional<std::variant<Types...>> made;
    static_cast<void>(
        ((Types::name == name ? (made.emplace(Types::from(settings)), true) : false) || ...));
    return made;
  }
};

using Integrators = IntegratorList<Integrator>;

}  // namespace portalens
