/// \file
/// The types of a list, for tests that try each.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/parameters.h"

namespace portalens::test {

template <class Variant>
struct TypesOf;
template <class... Types>
struct TypesOf<std::variant<Types...>> {
  using type = testing::Types<Types...>;
};

[[nodiscard]] inline Value value_of(double x) { return {x, {}}; }
[[nodiscard]] inline Value value_of(const Triple& t) {
  return {Value::List{value_of(t[0]), value_of(t[1]), value_of(t[2])}, {}};
}

/// What a newcomer makes of a table with all the keys that its kind may have: it takes those that
/// it knows. Where this does not do, it needs `Samples` of its own.
template <class Type, class... More>
[[nodiscard]] std::vector<Type> from_common_keys(const Table& table, const More&... more) {
  Faults faults;
  Parameters parameters(table, faults);
  std::vector<Type> made{Type::from(parameters, more...)};
  EXPECT_TRUE(faults.empty()) << "the common keys do not make a " << Type::name;
  return made;
}

}  // namespace portalens::test
