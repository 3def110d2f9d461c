/// \file
/// Values with their places, and the reader that turns a table of them into typed parameters.
///
/// A `Table` is what a file said, uninterpreted; `Parameters` interprets it. Whatever asks for a
/// key makes that key known, so the list of known keys is never written twice: `finish` reports the
/// keys that nobody asked for, and suggests the nearest that somebody did.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/error.h"
#include "core/words.h"

namespace portalens {

struct Entry;

/// One value of a scene file.
struct Value {
  using List = std::vector<Value>;
  using Dictionary = std::vector<Entry>;
  std::variant<bool, std::int64_t, double, std::string, List, Dictionary> data;
  Location where;
};

/// A key and its value.
struct Entry {
  std::string key;
  Value value;
};

/// A named group of values: a `[section]`, or one `[[element]]` of a list.
struct Table {
  std::string kind;  ///< "camera", "sphere", "material", ...
  Location where;
  Value::Dictionary entries;

  [[nodiscard]] const Value* find(std::string_view key) const;
  /// Adds the value, or replaces the one that stands there.
  void set(std::string_view key, Value value);
};

/// "a string", "a list", ...: what a value is, for messages.
[[nodiscard]] std::string describe(const Value& value);

/// What a number must satisfy.
struct Bounds {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool open_low = false;  ///< `low` itself is not allowed
};
inline constexpr Bounds any_number{};
inline constexpr Bounds positive{0.0, std::numeric_limits<double>::infinity(), true};
inline constexpr Bounds non_negative{0.0, std::numeric_limits<double>::infinity(), false};
inline constexpr Bounds unit_interval{0.0, 1.0, false};

using Triple = std::array<double, 3>;

/// Typed access to a table. A missing fallback means that the key is required. Each mistake is
/// added to the collector, and a harmless value returned, so that reading goes on to the next.
class Parameters {
 public:
  Parameters(const Table& table, Faults& faults);

  [[nodiscard]] bool has(std::string_view key);
  /// Where the key stands, or the table if it is absent.
  [[nodiscard]] Location where(std::string_view key) const;
  [[nodiscard]] Location where() const { return table_->where; }
  [[nodiscard]] const std::string& kind() const { return table_->kind; }
  [[nodiscard]] Faults& faults() { return *faults_; }

  double number(std::string_view key, Bounds bounds = any_number,
                std::optional<double> fallback = std::nullopt);
  std::int64_t integer(std::string_view key, std::int64_t low, std::int64_t high,
                       std::optional<std::int64_t> fallback = std::nullopt);
  bool boolean(std::string_view key, std::optional<bool> fallback = std::nullopt);
  std::string text(std::string_view key, const std::optional<std::string>& fallback = std::nullopt);
  /// One of `known`; the message for another word lists them.
  std::string choice(std::string_view key, std::span<const std::string_view> known,
                     const std::optional<std::string>& fallback = std::nullopt);
  Triple triple(std::string_view key, Bounds bounds = any_number,
                std::optional<Triple> fallback = std::nullopt);
  /// A list of points; `low` to `high` of them.
  std::vector<Triple> points(std::string_view key, std::size_t low, std::size_t high);
  /// A number, or one for each axis.
  Triple number_or_triple(std::string_view key, Bounds bounds = any_number,
                          std::optional<Triple> fallback = std::nullopt);
  /// The value itself, for keys that take several forms; null if absent.
  const Value* raw(std::string_view key);

  void fault(std::string_view key, std::string problem, std::string remedy);
  /// Reports every key that nobody asked for; one that was probably meant for a missing key, in
  /// place of that.
  void finish();

 private:
  const Value* require(std::string_view key, bool optional, std::string_view what);
  bool checked_finite(const Value& value, Bounds bounds, double& number) const;
  std::optional<Triple> checked_triple(std::string_view key, const Value& value, Bounds bounds,
                                       const std::string& remedy, std::string_view verb = " is ");
  void fault_at(const Value& value, std::string problem, std::string remedy);

  const Table* table_;
  Faults* faults_;
  std::set<std::string, std::less<>> known_;
  std::map<std::string, std::size_t, std::less<>> missing_;  ///< which fault told of each
};

}  // namespace portalens
