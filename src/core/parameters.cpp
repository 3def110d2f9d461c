#include "core/parameters.h"

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>
#include <utility>

namespace portalens {
namespace {

/// The shortest decimal that says the number well enough for a message.
std::string written(double number) {
  std::ostringstream stream;
  stream.imbue(std::locale::classic());
  stream << number;
  return stream.str();
}

/// "a number greater than 0": what would be right.
std::string wanted(std::string_view noun, const Bounds& bounds) {
  std::string text(noun);
  const bool low = std::isfinite(bounds.low), high = std::isfinite(bounds.high);
  if (low && high && !bounds.open_low) {
    return text + " from " + written(bounds.low) + " to " + written(bounds.high);
  }
  if (low) text += (bounds.open_low ? " greater than " : " of at least ") + written(bounds.low);
  if (high) text += (low ? " and at most " : " of at most ") + written(bounds.high);
  return text;
}

/// A number inside the bounds, to go on with after a fault.
double harmless(const Bounds& bounds) {
  const bool low = std::isfinite(bounds.low), high = std::isfinite(bounds.high);
  if (low && high) return 0.5 * (bounds.low + bounds.high);
  if (low) return bounds.low + 1.0;
  return high ? std::min(0.0, bounds.high) : 0.0;
}

/// An integer or a float as a double; nothing for anything else.
std::optional<double> as_number(const Value& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&value.data)) {
    return static_cast<double>(*integer);
  }
  if (const auto* number = std::get_if<double>(&value.data)) return *number;
  return std::nullopt;
}

bool inside(double number, const Bounds& bounds) {
  if (!std::isfinite(number) || number > bounds.high) return false;
  return bounds.open_low ? number > bounds.low : number >= bounds.low;
}

/// The number itself if it is one, else what it is instead.
std::string found(const Value& value) {
  const auto number = as_number(value);
  return number ? written(*number) : describe(value);
}

std::string is(std::string_view key, const std::string& what) {
  return in_quotes(key) + " is " + what;
}

bool printable(const std::string& text) {
  return std::none_of(text.begin(), text.end(), [](char letter) {
    const auto code = static_cast<unsigned char>(letter);
    return code < 0x20 || code == 0x7f;
  });
}

}  // namespace

std::string describe(const Value& value) {
  struct Name {
    std::string operator()(bool flag) const { return flag ? "true" : "false"; }
    std::string operator()(std::int64_t) const { return "an integer"; }
    std::string operator()(double number) const {
      return std::isfinite(number) ? "a number" : written(number);
    }
    std::string operator()(const std::string&) const { return "a string"; }
    std::string operator()(const Value::List& list) const {
      return "a list of " + std::to_string(list.size());
    }
    std::string operator()(const Value::Dictionary&) const { return "a table"; }
  };
  return std::visit(Name{}, value.data);
}

const Value* Table::find(std::string_view key) const {
  for (const auto& [name, value] : entries) {
    if (name == key) return &value;
  }
  return nullptr;
}

void Table::set(std::string_view key, Value value) {
  for (auto& [name, old] : entries) {
    if (name == key) {
      old = std::move(value);
      return;
    }
  }
  entries.push_back({std::string(key), std::move(value)});
}

Parameters::Parameters(const Table& table, Faults& faults) : table_(&table), faults_(&faults) {}

bool Parameters::has(std::string_view key) { return raw(key) != nullptr; }

Location Parameters::where(std::string_view key) const {
  const Value* value = table_->find(key);
  return value ? value->where : table_->where;
}

const Value* Parameters::raw(std::string_view key) {
  known_.emplace(key);
  return table_->find(key);
}

const Value* Parameters::require(std::string_view key, bool optional, std::string_view what) {
  const Value* value = raw(key);
  if (!value && !optional) {
    missing_.emplace(key, faults_->size());
    faults_->add(table_->where, table_->kind + " has no " + in_quotes(key),
                 "give it " + std::string(what));
  }
  return value;
}

void Parameters::fault_at(const Value& value, std::string problem, std::string remedy) {
  faults_->add(value.where, std::move(problem), std::move(remedy));
}

void Parameters::fault(std::string_view key, std::string problem, std::string remedy) {
  faults_->add(where(key), std::move(problem), std::move(remedy));
}

bool Parameters::checked_finite(const Value& value, Bounds bounds, double& number) const {
  const auto given = as_number(value);
  if (!given || !inside(*given, bounds)) return false;
  number = *given;
  return true;
}

double Parameters::number(std::string_view key, Bounds bounds, std::optional<double> fallback) {
  const std::string want = wanted("a number", bounds);
  double result = fallback.value_or(harmless(bounds));
  const Value* value = require(key, fallback.has_value(), want);
  if (value && !checked_finite(*value, bounds, result)) {
    fault_at(*value, is(key, found(*value)), "give " + want);
  }
  return result;
}

std::int64_t Parameters::integer(std::string_view key, std::int64_t low, std::int64_t high,
                                 std::optional<std::int64_t> fallback) {
  const std::string want =
      "a whole number from " + std::to_string(low) + " to " + std::to_string(high);
  const Value* value = require(key, fallback.has_value(), want);
  const std::int64_t otherwise = fallback.value_or(low);
  if (!value) return otherwise;
  const auto* given = std::get_if<std::int64_t>(&value->data);
  if (given && *given >= low && *given <= high) return *given;
  fault_at(*value, is(key, given ? std::to_string(*given) : found(*value)), "give " + want);
  return otherwise;
}

bool Parameters::boolean(std::string_view key, std::optional<bool> fallback) {
  const Value* value = require(key, fallback.has_value(), "true or false");
  if (!value) return fallback.value_or(false);
  if (const auto* given = std::get_if<bool>(&value->data)) return *given;
  fault_at(*value, is(key, describe(*value)), "give true or false");
  return fallback.value_or(false);
}

std::string Parameters::text(std::string_view key, const std::optional<std::string>& fallback) {
  const Value* value = require(key, fallback.has_value(), "a string");
  if (!value) return fallback.value_or("");
  const auto* given = std::get_if<std::string>(&value->data);
  if (given && printable(*given)) return *given;
  if (given) {
    fault_at(*value, in_quotes(key) + " contains a control character", "leave it out");
  } else {
    fault_at(*value, is(key, describe(*value)), "give a string");
  }
  return fallback.value_or("");
}

std::string Parameters::choice(std::string_view key, std::span<const std::string_view> known,
                               const std::optional<std::string>& fallback) {
  const std::vector<std::string> words(known.begin(), known.end());
  const Value* value = require(key, fallback.has_value(), "one of " + listed(words));
  std::string otherwise = fallback ? *fallback : words.empty() ? "" : words.front();
  if (!value) return otherwise;
  const auto* given = std::get_if<std::string>(&value->data);
  if (!given) {
    fault_at(*value, is(key, describe(*value)), "give one of " + listed(words));
    return otherwise;
  }
  if (std::find(words.begin(), words.end(), *given) != words.end()) return *given;
  const std::string guess = suggestion(*given, words);
  fault_at(*value, "unknown " + std::string(key) + " " + in_quotes(*given),
           guess.empty() ? "known are " + listed(words)
                         : "did you mean " + guess + "? known are " + listed(words));
  return otherwise;
}

std::optional<Triple> Parameters::checked_triple(std::string_view key, const Value& value,
                                                 Bounds bounds, const std::string& remedy,
                                                 std::string_view verb) {
  const auto* list = std::get_if<Value::List>(&value.data);
  if (!list || list->size() != 3) {
    fault_at(value, in_quotes(key) + std::string(verb) + found(value), remedy);
    return std::nullopt;
  }
  Triple triple{};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!checked_finite((*list)[i], bounds, triple[i])) {
      fault_at((*list)[i], in_quotes(key) + " contains " + found((*list)[i]), remedy);
      return std::nullopt;
    }
  }
  return triple;
}

Triple Parameters::triple(std::string_view key, Bounds bounds, std::optional<Triple> fallback) {
  const std::string want = "a list of three numbers" + wanted("", bounds);
  const double safe = harmless(bounds);
  const Triple otherwise = fallback.value_or(Triple{safe, safe, safe});
  const Value* value = require(key, fallback.has_value(), want);
  return value ? checked_triple(key, *value, bounds, "give " + want).value_or(otherwise)
               : otherwise;
}

std::vector<Triple> Parameters::points(std::string_view key, std::size_t low, std::size_t high) {
  const std::string count =
      low == high ? std::to_string(low) : std::to_string(low) + " to " + std::to_string(high);
  const std::string want = "a list of " + count + " points [x, y, z]";
  const Value* value = require(key, false, want);
  if (!value) return {};
  const auto* list = std::get_if<Value::List>(&value->data);
  if (!list || list->size() < low || list->size() > high) {
    fault_at(*value, is(key, found(*value)), "give " + want);
    return {};
  }
  std::vector<Triple> points;
  for (const Value& element : *list) {
    const auto point = checked_triple(key, element, any_number, "give " + want, " contains ");
    if (!point) return {};
    points.push_back(*point);
  }
  return points;
}

Triple Parameters::number_or_triple(std::string_view key, Bounds bounds,
                                    std::optional<Triple> fallback) {
  const std::string want = wanted("a number", bounds) + ", or a list of three" + wanted("", bounds);
  const double safe = harmless(bounds);
  const Triple otherwise = fallback.value_or(Triple{safe, safe, safe});
  const Value* value = require(key, fallback.has_value(), want);
  if (!value) return otherwise;
  if (as_number(*value)) {
    double number = 0.0;
    if (checked_finite(*value, bounds, number)) return {number, number, number};
    fault_at(*value, is(key, found(*value)), "give " + want);
    return otherwise;
  }
  return checked_triple(key, *value, bounds, "give " + want).value_or(otherwise);
}

void Parameters::finish() {
  const std::vector<std::string> known(known_.begin(), known_.end());
  for (const auto& [key, value] : table_->entries) {
    if (known_.count(key) > 0) continue;
    const std::string problem = "unknown key " + in_quotes(key);
    const std::string remedy = suggestion_or_list(key, known);
    const auto meant = missing_.find(suggestion(key, known));
    if (meant == missing_.end()) {
      faults_->add(value.where, problem, remedy);
    } else {
      faults_->replace(meant->second, value.where, problem, remedy);
      missing_.erase(meant);
    }
  }
}

}  // namespace portalens
