#include "io/toml_letters.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace portalens {
namespace {

// Byte b is written as U+10FF00 + (b - 0x80): the bytes f4 8f bc 80 to f4 8f bd bf.
constexpr std::string_view mark = "\xf4\x8f";
constexpr unsigned third = 0xbc;

unsigned code_of(char letter) { return static_cast<unsigned char>(letter); }

/// How many bytes the letter takes that begins the text; 0 if it is none. Unicode 15, table 3-7.
std::size_t letter_length(std::string_view text) {
  const unsigned first = code_of(text[0]);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
  const unsigned second = code_of(text[1]);
  const unsigned low = first == 0xe0 ? 0xa0 : first == 0xf0 ? 0x90 : 0x80;
  const unsigned high = first == 0xed ? 0x9f : first == 0xf4 ? 0x8f : 0xbf;
  if (second < low || second > high) return 0;
  const bool goes_on = std::all_of(text.begin() + 2, text.begin() + static_cast<long>(length),
                                   [](char letter) { return (code_of(letter) & 0xc0) == 0x80; });
  return goes_on ? length : 0;
}

}  // namespace

int line_not_utf8(std::string_view text) {
  int line = 1;
  while (!text.empty()) {
    const std::size_t length = letter_length(text);
    if (length == 0) return line;
    if (text[0] == '\n') ++line;
    text.remove_prefix(length);
  }
  return 0;
}

std::string disguised(std::string_view text) {
  std::string result;
  for (const char letter : text) {
    const unsigned code = code_of(letter);
    if (code < 0x80) {
      result += letter;
    } else {
      result += mark;
      result += static_cast<char>(third + (code - 0x80) / 64);
      result += static_cast<char>(0x80 + code % 64);
    }
  }
  return result;
}

std::string undisguised(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const bool dressed = text.size() >= 4 && text.substr(0, 2) == mark &&
                         (code_of(text[2]) == third || code_of(text[2]) == third + 1);
    if (dressed) {
      result += static_cast<char>(0x80 + (code_of(text[2]) - third) * 64 + code_of(text[3]) % 64);
    } else {
      result += text[0];
    }
    text.remove_prefix(dressed ? 4 : 1);
  }
  return result;
}

}  // namespace portalens
