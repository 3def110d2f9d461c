/// \file
/// Options of the command line whose value is one of a few names.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <string>
#include <utility>
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

/// For `check`: takes a number from `low` to `high`; `nan` is none.
[[nodiscard]] inline CLI::Validator number_within(double low, double high) {
  const auto judge = [low, high](const std::string& word) -> std::string {
    double number = 0.0;
    const bool sound = CLI::detail::lexical_cast(word, number) && number >= low && number <= high;
    return sound ? std::string{}
                 : in_quotes(word) + " is no number from " + fmt::format("{:g} to {:g}", low, high);
  };
  return CLI::Validator(judge, "");
}

/// For `check`: takes one of the words; of another it tells them.
[[nodiscard]] inline CLI::Validator known_word(std::vector<std::string> words) {
  const auto judge = [words = std::move(words)](const std::string& word) -> std::string {
    if (std::find(words.begin(), words.end(), word) != words.end()) return {};
    return "unknown " + in_quotes(word) + "; " + suggestion_or_list(word, words);
  };
  return CLI::Validator(judge, "");
}

}  // namespace portalens
