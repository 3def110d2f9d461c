/// \file
/// Characters of a text, whatever its bytes.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace portalens {

/// The code points of a UTF-8 text; U+FFFD for each byte that belongs to none.
[[nodiscard]] inline std::u32string code_points(std::string_view text) {
  std::u32string codes;
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i]);
    const std::size_t size = first < 0x80   ? 1
                             : first < 0xc2 ? 0
                             : first < 0xe0 ? 2
                             : first < 0xf0 ? 3
                             : first < 0xf5 ? 4
                                            : 0;
    char32_t code = size <= 1 ? first : first & (0x7fu >> size);
    bool whole = size > 0 && i + size <= text.size();
    for (std::size_t k = 1; whole && k < size; ++k) {
      const auto next = static_cast<unsigned char>(text[i + k]);
      whole = (next & 0xc0) == 0x80;
      code = code << 6 | (next & 0x3f);
    }
    constexpr char32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    whole = whole && code >= least[size] && code <= 0x10ffff && (code & 0xfffff800) != 0xd800;
    codes += whole ? code : U'\ufffd';
    i += whole ? size : 1;
  }
  return codes;
}

/// @pre a code point, no surrogate
[[nodiscard]] inline std::string to_utf8(char32_t code) {
  const auto tail = [code](int shift) { return static_cast<char>(0x80 | (code >> shift & 0x3f)); };
  if (code < 0x80) return {static_cast<char>(code)};
  if (code < 0x800) return {static_cast<char>(0xc0 | code >> 6), tail(0)};
  if (code < 0x10000) return {static_cast<char>(0xe0 | code >> 12), tail(6), tail(0)};
  return {static_cast<char>(0xf0 | code >> 18), tail(12), tail(6), tail(0)};
}

}  // namespace portalens
