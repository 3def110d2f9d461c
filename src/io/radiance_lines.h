/// \file
/// The lines of a Radiance picture: flat, or in either of the format's two run-length codings.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace portalens {

/// Three mantissas and their exponent.
using SharedExponent = std::array<unsigned char, 4>;

/// Each line says for itself how it is coded.
class RadianceLines {
 public:
  /// @param bytes  those after the header
  explicit RadianceLines(std::string_view bytes) : left_(bytes) {}

  /// Fills a line with the next pixels.
  /// @throws Refusal if they are cut off, or don't come out as long as the line
  void read(std::span<SharedExponent> line);

 private:
  unsigned char byte();
  [[nodiscard]] bool begins_by_components(std::size_t length) const;
  void read_by_components(std::span<SharedExponent> line);
  void read_by_pixels(std::span<SharedExponent> line);

  std::string_view left_;
};

}  // namespace portalens
