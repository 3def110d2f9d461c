#include "io/checksums.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace portalens {
namespace {

/// What each byte does to the sum, for a byte that stands so many zeros before the end.
constexpr std::size_t at_once = 8;
using Table = std::array<std::array<std::uint32_t, 256>, at_once>;

constexpr Table crc_table() {
  Table table{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t sum = byte;
    for (int bit = 0; bit < 8; ++bit) sum = sum >> 1 ^ (sum & 1 ? 0xedb88320u : 0u);
    table[0][byte] = sum;
  }
  for (std::size_t zeros = 1; zeros < at_once; ++zeros)
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
      const std::uint32_t before = table[zeros - 1][byte];
      table[zeros][byte] = before >> 8 ^ table[0][before & 0xff];
    }
  return table;
}

constexpr Table crc_of = crc_table();

std::uint32_t byte_at(std::string_view bytes, std::size_t at) {
  return static_cast<unsigned char>(bytes[at]);
}

}  // namespace

std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t sum = ~0u;
  while (bytes.size() >= at_once) {
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < at_once; ++i) {
      const std::uint32_t begun = i < 4 ? sum >> 8 * i & 0xff : 0;
      next ^= crc_of[at_once - 1 - i][byte_at(bytes, i) ^ begun];
    }
    sum = next;
    bytes.remove_prefix(at_once);
  }
  for (std::size_t i = 0; i < bytes.size(); ++i)
    sum = sum >> 8 ^ crc_of[0][(sum ^ byte_at(bytes, i)) & 0xff];
  return ~sum;
}

std::uint32_t adler32(std::string_view bytes, std::uint32_t begun) {
  constexpr std::uint32_t modulus = 65521;
  constexpr std::size_t before_overflow = 5552;
  std::uint32_t low = begun & 0xffff, high = begun >> 16;
  while (!bytes.empty()) {
    const std::size_t count = std::min(before_overflow, bytes.size());
    for (std::size_t i = 0; i < count; ++i) high += low += byte_at(bytes, i);
    low %= modulus;
    high %= modulus;
    bytes.remove_prefix(count);
  }
  return high << 16 | low;
}

}  // namespace portalens
