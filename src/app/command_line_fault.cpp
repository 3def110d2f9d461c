#include "app/command_line_fault.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/words.h"

namespace portalens {
namespace {

/// "--ray X Y Z DX DY DZ"
std::string usage_of(const CLI::App& command, const std::string& option) {
  const CLI::Option* known = command.get_option_no_throw(option);
  return known ? option + " " + known->get_type_name() : option;
}

/// What a word is not, by the type of its option.
std::string what_it_is_not(const std::string& word, const std::string& type) {
  constexpr std::string_view digits = "0123456789";
  const std::size_t begin = word.starts_with('-') ? 1 : 0;
  const bool whole =
      word.size() > begin && word.find_first_not_of(digits, begin) == std::string::npos;
  if (whole) return "in range";
  if (type == "INT" || type == "UINT" || type == "N" || type == "A" || type == "B")
    return "a whole number";
  return "a number";
}

/// What stands around the first `between` in a text; nothing if that is not in it.
std::optional<std::pair<std::string, std::string>> around(const std::string& text,
                                                          std::string_view between) {
  const std::size_t at = text.find(between);
  if (at == std::string::npos) return std::nullopt;
  return std::pair(text.substr(0, at), text.substr(at + between.size()));
}

/// "Could not convert: OPTION = WORD"
std::optional<Fault> about_conversion(const CLI::App& command, const std::string& text) {
  const auto after = around(text, "Could not convert: ");
  const auto said = after ? around(after->second, " = ") : std::nullopt;
  if (!said || !after->first.empty()) return std::nullopt;
  const auto& [name, word] = *said;
  const CLI::Option* option = command.get_option_no_throw(name);
  return Fault{{},
               name + ": " + in_quotes(word) + " is not " +
                   what_it_is_not(word, option ? option->get_type_name() : ""),
               "write " + usage_of(command, name)};
}

/// "OPTION: At least 6 required but received 5", or At Most; "OPTION: 6 required TYPE missing"
std::optional<Fault> about_count(const CLI::App& command, const std::string& text) {
  const auto no_value = around(text, ": ");
  if (no_value && text.ends_with(" missing") &&
      no_value->second.find(" required ") != std::string::npos)
    return Fault{
        {}, no_value->first + " lacks values", "write " + usage_of(command, no_value->first)};
  for (const char* limit : {": At least ", ": At Most "}) {
    const auto said = around(text, limit);
    const auto numbers = said ? around(said->second, " required but received ") : std::nullopt;
    if (numbers)
      return Fault{{},
                   said->first + " has " + numbers->second + " values, not " + numbers->first,
                   "write " + usage_of(command, said->first)};
  }
  return std::nullopt;
}

/// "OPTION excludes OPTION", "OPTION requires OPTION"
std::optional<Fault> about_company(const std::string& text) {
  if (!text.starts_with('-')) return std::nullopt;
  if (const auto two = around(text, " excludes "))
    return Fault{
        {}, two->first + " and " + two->second + " exclude each other", "leave one of them out"};
  if (const auto two = around(text, " requires "))
    return Fault{{}, two->first + " is of use only with " + two->second, "give that, too"};
  return std::nullopt;
}

/// The sentences that CLI11 has for what people mistype most; nothing for any other.
std::optional<Fault> in_our_words(const CLI::App& command, const std::string& text) {
  if (auto fault = about_conversion(command, text)) return fault;
  if (auto fault = about_count(command, text)) return fault;
  return about_company(text);
}

}  // namespace

std::optional<Fault> missing_value(const CLI::App& program,
                                   const std::vector<std::string>& arguments) {
  if (arguments.empty()) return std::nullopt;
  const auto named = program.get_subcommands(
      [&](const CLI::App* one) { return one->get_name() == arguments.front(); });
  if (named.empty()) return std::nullopt;
  const auto option_called = [&](const std::string& word) {
    return word.starts_with('-') ? named.front()->get_option_no_throw(word) : nullptr;
  };
  for (std::size_t i = 1; i < arguments.size() && arguments[i] != "--"; ++i) {
    const CLI::Option* option = option_called(arguments[i]);
    if (!option || option->get_items_expected_min() == 0) continue;
    if (i + 1 == arguments.size() || option_called(arguments[i + 1]))
      return Fault{
          {}, arguments[i] + " lacks values", "write " + usage_of(*named.front(), arguments[i])};
  }
  return std::nullopt;
}

Fault fault_of(const CLI::App& program, const CLI::ParseError& error) {
  const std::vector<CLI::App*> named = program.get_subcommands();
  if (named.empty()) {
    std::vector<std::string> known;
    for (const CLI::App* command : program.get_subcommands({}))
      known.push_back(command->get_name());
    const std::vector<std::string> rest = program.remaining();
    if (rest.empty()) return {{}, "a command is missing", "known are " + listed(known)};
    const bool option = rest.front().starts_with('-');
    return {{},
            (option ? "unknown option " : "unknown command ") + in_quotes(rest.front()),
            option ? "try portalens --help" : suggestion_or_list(rest.front(), known)};
  }
  const CLI::App& command = *named.front();
  const std::string help = "try portalens " + command.get_name() + " --help";
  std::vector<std::string> rest = command.remaining();
  if (rest.empty()) rest = program.remaining();
  if (rest.empty())
    return in_our_words(command, error.what()).value_or(Fault{{}, error.what(), help});
  const auto option = std::find_if(rest.begin(), rest.end(),
                                   [](const std::string& word) { return word.starts_with('-'); });
  if (option == rest.end()) return {{}, "nothing is known to do with " + in_quotes(rest[0]), help};
  std::vector<std::string> known;
  for (const CLI::Option* one : command.get_options())
    for (const std::string& name : one->get_lnames()) known.push_back("--" + name);
  const std::string meant = suggestion(*option, known);
  return {{},
          "unknown option " + in_quotes(*option),
          meant.empty() ? help : "did you mean " + meant + '?'};
}

}  // namespace portalens
