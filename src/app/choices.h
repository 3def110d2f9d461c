/// \file
/// Options of the command line whose value is one of a few names.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

#include "core/words.h"

namespace portalens {

/// For `transform`: takes one of the names, for its value; of another word it tells the names.
/// @tparam Choice  an enumeration
template <class Choice>
[[nodiscard]] CLI::Validator one_of(std::map<std::string, Choice> names) {
  const auto choose = [names = std::move(names)](std::string& word) -> std::string {
    const auto found = names.find(word);
    if (found != names.end()) {
      word = std::to_string(static_cast<int>(found->second));
      return {};
    }
    std::vector<std::string> known;
    for (const auto& [name, value] : names) known.push_back(name);
    return "unknown " + in_quotes(word) + "; " + suggestion_or_list(word, known);
  };
  return CLI::Validator(choose, "");
}

}  // namespace portalens
