/// \file
/// A list of types that each have a `name` and a `from(Parameters&)`: choosing one by its name.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/parameters.h"

namespace portalens {

template <class Variant>
struct Choice;

/// What a `std::variant` of such types can be asked.
template <class... Types>
struct Choice<std::variant<Types...>> {
  [[nodiscard]] static std::vector<std::string_view> names() { return {Types::name...}; }

  /// The type with that name, made from the parameters; nothing if no type has it.
  [[nodiscard]] static std::optional<std::variant<Types...>> make(std::string_view name,
                                                                  Parameters& parameters) {
    std::optional<std::variant<Types...>> made;
    static_cast<void>(
        ((Types::name == name ? (made.emplace(Types::from(parameters)), true) : false) || ...));
    return made;
  }
};

}  // namespace portalens
