/// \file
/// The header of a Radiance picture, as "Radiance File Formats" (Ward,
/// floyd.lbl.gov/radiance/refer/ filefmts.pdf) describes it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace portalens {

enum class RadianceColors { rgb, xyz };

struct RadianceHeader {
  RadianceColors colors = RadianceColors::rgb;
  /// By what the three values of each pixel have been multiplied: the product of all lines EXPOSURE
  /// and COLORCORR.
  std::array<double, 3> multiplied{1.0, 1.0, 1.0};
  std::int64_t width = 0, height = 0;
  /// Pixels lie column by column; else row by row.
  bool by_columns = false;
  bool right_to_left = false, bottom_up = false;
  /// Bytes before the first pixel.
  std::size_t size = 0;
};

/// The width and the height may be any numbers: `check_claim` holds them against the limits.
/// @throws Refusal if it is cut off, or says what can't be read
[[nodiscard]] RadianceHeader radiance_header(std::string_view bytes);

}  // namespace portalens
