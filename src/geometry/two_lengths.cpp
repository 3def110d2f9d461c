#include "geometry/two_lengths.h"

#include <cstdint>
#include <variant>

#include "core/words.h"
#include "geometry/extent.h"

namespace portalens {
namespace {

std::optional<double> length_in(const Value& value) {
  double found = 0.0;
  if (const auto* integer = std::get_if<std::int64_t>(&value.data))
    found = static_cast<double>(*integer);
  else if (const auto* number = std::get_if<double>(&value.data))
    found = *number;
  if (!(found > 0.0 && found <= largest_coordinate)) return std::nullopt;
  return found;
}

}  // namespace

std::optional<std::array<double, 2>> two_lengths(Parameters& parameters, std::string_view key,
                                                 OneNumber alone, const char* remedy) {
  const Value* value = parameters.raw(key);
  if (!value) {
    (void)parameters.number(key, positive);  // which tells that it is missing
    return std::nullopt;
  }
  if (const auto* list = std::get_if<Value::List>(&value->data)) {
    if (list->size() == 2) {
      const auto first = length_in((*list)[0]), second = length_in((*list)[1]);
      if (first && second) return std::array<double, 2>{*first, *second};
    }
  } else if (const auto both = length_in(*value); both && alone == OneNumber::stands_for_both) {
    return std::array<double, 2>{*both, *both};
  }
  parameters.fault(
      key, in_quotes(key) + " is " + describe(*value) + " that gives no two lengths from 0 to 1e12",
      remedy);
  return std::nullopt;
}

}  // namespace portalens
