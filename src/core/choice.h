/// \file
/// A list of types that each have a `name` and a `from(Parameters&, ...)`: choosing one by its
/// name. Types of the list without a name are made elsewhere.
#pragma once

#include <optional>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "core/parameters.h"

namespace portalens {

template <class Variant>
struct Choice;

/// What a `std::variant` of such types can be asked.
template <class... Types>
struct Choice<std::variant<Types...>> {
  [[nodiscard]] static std::vector<std::string_view> names() {
    std::vector<std::string_view> all;
    const auto add = [&]<class Type>(std::type_identity<Type>) {
      if constexpr (requires { Type::name; }) all.push_back(Type::name);
    };
    (add(std::type_identity<Types>{}), ...);
    return all;
  }

  /// The type with that name, made by its `from(parameters, more...)`; nothing if no type has it.
  template <class... More>
  [[nodiscard]] static std::optional<std::variant<Types...>> make(std::string_view name,
                                                                  Parameters& parameters,
                                                                  const More&... more) {
    std::optional<std::variant<Types...>> made;
    const auto try_one = [&]<class Type>(std::type_identity<Type>) {
      if constexpr (requires { Type::name; })
        if (!made && Type::name == name) made.emplace(Type::from(parameters, more...));
    };
    (try_one(std::type_identity<Types>{}), ...);
    return made;
  }
};

}  // namespace portalens
