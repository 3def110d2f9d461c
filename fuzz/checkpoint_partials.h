/// \file
/// How the file of a partial picture is laid out (docs/checkpoints.md), for whoever takes one
/// apart: mark and version, 20 bytes; the length of the head, 4; head; digest; body; digest.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

namespace portalens::fuzz {

inline constexpr std::string_view partial_mark = "portalens piece\n";
inline constexpr std::size_t preamble_size = 24, digest_size = 32;

/// The bytes cut before each mark; all of them if there is none.
inline std::vector<std::string_view> partials_in(std::string_view bytes) {
  std::vector<std::string_view> partials;
  std::size_t begin = 0;
  while (true) {
    const std::size_t end = bytes.find(partial_mark, begin + 1);
    partials.push_back(bytes.substr(begin, end - begin));
    if (end == bytes.npos) return partials;
    begin = end;
  }
}

/// The head, as far as it is there.
inline std::string_view head_of(std::string_view partial) {
  if (partial.size() < preamble_size) return {};
  std::uint32_t size = 0;
  std::memcpy(&size, partial.data() + preamble_size - sizeof size, sizeof size);
  return partial.substr(preamble_size, size);
}

}  // namespace portalens::fuzz
