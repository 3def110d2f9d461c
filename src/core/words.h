/// \file
/// Words in messages: quoting what a file said, listing what is known, guessing what was meant.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace portalens {

/// `'word'`, safe to print: control characters become `?`, a long word is cut short.
[[nodiscard]] std::string in_quotes(std::string_view word);

/// Without what would move a terminal's cursor, or worse: names and bytes of a stranger's file end
/// up in messages. A line's end becomes a blank, other control characters `?`.
[[nodiscard]] std::string harmless(std::string text);

/// `a, b, c`; a long list is cut short.
[[nodiscard]] std::string listed(const std::vector<std::string>& words);

/// The member of `known` that `word` was probably meant to be, or an empty string: the same word in
/// another case or with other separators, a word other renderers use for it, or a small edit
/// distance (Damerau-Levenshtein: a swap of neighbours counts as one edit).
[[nodiscard]] std::string suggestion(std::string_view word, const std::vector<std::string>& known);

/// `did you mean X?`, or `known are a, b, c` if nothing comes near.
[[nodiscard]] std::string suggestion_or_list(std::string_view word,
                                             const std::vector<std::string>& known);

}  // namespace portalens
