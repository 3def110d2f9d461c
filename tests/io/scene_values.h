/// \file
/// Values of a scene's tables, as tests expect them.
#pragma once

#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "core/parameters.h"

namespace portalens::test {

inline double number_of(const Table& table, const std::string& key) {
  const Value* value = table.find(key);
  return value ? std::get<double>(value->data) : NAN;
}

inline std::string text_of(const Table& table, const std::string& key) {
  const Value* value = table.find(key);
  return value ? std::get<std::string>(value->data) : "(none)";
}

/// The numbers of a list, or of a list of lists, in order.
inline std::vector<double> numbers_of(const Value& value) {
  if (const auto* number = std::get_if<double>(&value.data)) return {*number};
  std::vector<double> numbers;
  for (const Value& element : std::get<Value::List>(value.data)) {
    const auto more = numbers_of(element);
    numbers.insert(numbers.end(), more.begin(), more.end());
  }
  return numbers;
}
using Numbers = std::vector<double>;

}  // namespace portalens::test
