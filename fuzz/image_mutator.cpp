// Mends the checksums of a PNG after each mutation: else none would get past them.
#include <cstddef>
#include <cstdint>

#include "target.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

/// The checksum of PNG's chunks (ISO 15948, annex D), a bit at a time.
std::uint32_t checksum(const std::uint8_t* bytes, std::size_t count) {
  std::uint32_t sum = 0xffffffffU;
  for (std::size_t i = 0; i < count; ++i) {
    sum ^= bytes[i];
    for (int bit = 0; bit < 8; ++bit) sum = (sum & 1U) ? 0xedb88320U ^ (sum >> 1) : sum >> 1;
  }
  return ~sum;
}

std::size_t big_endian(const std::uint8_t* bytes) {
  std::size_t number = 0;
  for (int i = 0; i < 4; ++i) number = number << 8 | bytes[i];
  return number;
}

void mend_checksums(std::uint8_t* data, std::size_t size) {
  for (std::size_t at = 8; at + 12 <= size;) {
    const std::size_t length = big_endian(data + at);
    if (length > size - at - 12) return;
    const std::uint32_t sum = checksum(data + at + 4, length + 4);
    for (int i = 0; i < 4; ++i)
      data[at + 8 + length + static_cast<std::size_t>(i)] =
          static_cast<std::uint8_t>(sum >> (24 - 8 * i));
    at += length + 12;
  }
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned int seed) {
  const std::size_t changed = LLVMFuzzerMutate(data, size, most);
  const bool png = portalens::fuzz::as_text(data, changed).substr(0, 4) == "\x89PNG";
  if (png && seed % 16 != 0) mend_checksums(data, changed);  // a wrong one must be refused, too
  return changed;
}
