/// \file
/// Words of a text and the numbers they say, strictly: what isn't wholly a number is none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace portalens {

/// The finite number that is the whole of `word`; no locale, no hexadecimal, no nan or infinity.
[[nodiscard]] std::optional<double> parse_number(std::string_view word);
[[nodiscard]] std::optional<std::int64_t> parse_integer(std::string_view word);

/// A word and its line; empty at the end of the text.
struct Token {
  std::string_view text;
  int line = 0;
  [[nodiscard]] bool at_end() const { return text.empty(); }
};

/// A text as white-space separated words; `#` starts a comment that ends with its line.
class TokenStream {
 public:
  explicit TokenStream(std::string_view text);

  Token next();
  [[nodiscard]] Token peek() const;
  /// Like `next`, but `<`, `>`, `,`, `{` and `}` are words of their own.
  Token next_part();
  [[nodiscard]] Token peek_part() const;

 private:
  void pass_space();

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
};

}  // namespace portalens
