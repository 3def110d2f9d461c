// "Radiance File Formats" (Ward), and "Real Pixels" (Ward, Graphics Gems II, 1991).
#include "io/radiance_lines.h"

#include <algorithm>

#include "io/image_claim.h"

namespace portalens {
namespace {

[[noreturn]] void refuse(const char* why) {
  throw Refusal{std::string("is broken: ") + why, "save it again"};
}

}  // namespace

unsigned char RadianceLines::byte() {
  if (left_.empty()) refuse("its pixels are cut off");
  const auto taken = static_cast<unsigned char>(left_.front());
  left_.remove_prefix(1);
  return taken;
}

/// The second coding begins with 2, 2 and the length; the high bit of the length is not set.
bool RadianceLines::begins_by_components(std::size_t length) const {
  constexpr std::size_t shortest = 8, longest = 0x7fff;
  if (length < shortest || length > longest || left_.size() < 4) return false;
  return left_[0] == 2 && left_[1] == 2 && static_cast<unsigned char>(left_[2]) < 128;
}

void RadianceLines::read(std::span<SharedExponent> line) {
  if (begins_by_components(line.size())) {
    read_by_components(line);
  } else {
    read_by_pixels(line);
  }
}

/// The second coding: each component of all pixels, then the next. A count above 128 tells how
/// often the one byte after it stands, any other count tells how many bytes follow.
void RadianceLines::read_by_components(std::span<SharedExponent> line) {
  left_.remove_prefix(2);
  const std::size_t high = byte(), length = high << 8 | byte();
  if (length != line.size()) refuse("a line has another length than the picture");
  for (std::size_t component = 0; component < 4; ++component) {
    for (std::size_t at = 0; at < line.size();) {
      const std::size_t code = byte();
      const bool run = code > 128;
      const std::size_t end = at + (run ? code - 128 : code);
      if (end > line.size()) refuse("a run is longer than its line");
      const unsigned char repeated = run ? byte() : 0;
      for (; at < end; ++at) line[at][component] = run ? repeated : byte();
    }
  }
}

/// Flat, or the first coding: a pixel 1 1 1 n stands for n repetitions of the one before it; right
/// after another such it has the next higher 8 bits of the number.
void RadianceLines::read_by_pixels(std::span<SharedExponent> line) {
  constexpr unsigned highest_shift = 24;  // more than any line has
  unsigned shift = 0;
  for (std::size_t at = 0; at < line.size();) {
    SharedExponent pixel{};
    for (unsigned char& part : pixel) part = byte();
    if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
      line[at++] = pixel;
      shift = 0;
      continue;
    }
    const std::size_t count = std::size_t{pixel[3]} << shift;
    if (at == 0) refuse("a run has no pixel before it");
    if (count > line.size() - at) refuse("a run is longer than its line");
    std::fill_n(line.begin() + static_cast<std::ptrdiff_t>(at), count, line[at - 1]);
    at += count;
    shift = std::min(shift + 8, highest_shift);
  }
}

}  // namespace portalens
