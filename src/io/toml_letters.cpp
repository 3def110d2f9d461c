#include "io/toml_letters.h"

#include <utf8.h>

#include <algorithm>

namespace portalens {
namespace {

// Byte b is written as U+10FF00 + (b - 0x80): the bytes f4 8f bc 80 to f4 8f bd bf.
constexpr std::string_view mark = "\xf4\x8f";
constexpr unsigned third = 0xbc;

unsigned code_of(char letter) { return static_cast<unsigned char>(letter); }

}  // namespace

int line_not_utf8(std::string_view text) {
  const auto wrong = utf8::find_invalid(text.begin(), text.end());
  if (wrong == text.end()) return 0;
  return 1 + static_cast<int>(std::count(text.begin(), wrong, '\n'));
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
