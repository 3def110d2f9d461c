/// \file
/// Finding things of one kind by their names, and what to say where there is none.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/words.h"

namespace portalens {

class NameIndex {
 public:
  /// The first of equal names counts.
  void add(const std::string& name, std::uint32_t index) {
    if (place_of_.emplace(name, index).second) names_.push_back(name);
  }

  [[nodiscard]] bool empty() const { return names_.empty(); }

  [[nodiscard]] std::optional<std::uint32_t> find(const std::string& name) const {
    const auto found = place_of_.find(name);
    if (found == place_of_.end()) return std::nullopt;
    return found->second;
  }

  /// What the user may have meant by a name that is not there. Guessing costs time: after many
  /// guesses it names no more.
  [[nodiscard]] std::string guess(const std::string& name) {
    return guesses_++ < most_guesses ? suggestion_or_list(name, names_) : "see the faults above";
  }

 private:
  static constexpr int most_guesses = 100;

  std::map<std::string, std::uint32_t> place_of_;
  std::vector<std::string> names_;
  int guesses_ = 0;
};

}  // namespace portalens
