/// \file
/// Characters of a text, whatever its bytes.
#pragma once

#include <utf8.h>

#include <iterator>
#include <string>
#include <string_view>

namespace portalens {

/// The code points of a UTF-8 text; U+FFFD for each byte that belongs to none.
[[nodiscard]] inline std::u32string code_points(std::string_view text) {
  std::u32string codes;
  for (auto at = text.begin(); at != text.end();) {
    const auto valid = utf8::find_invalid(at, text.end());
    while (at != valid) codes += static_cast<char32_t>(utf8::unchecked::next(at));
    if (at == text.end()) break;
    codes += U'\ufffd';
    ++at;
  }
  return codes;
}

/// @pre a code point, no surrogate
[[nodiscard]] inline std::string to_utf8(char32_t code) {
  std::string text;
  utf8::unchecked::append(code, std::back_inserter(text));
  return text;
}

}  // namespace portalens
