/// \file
/// Numbers as colours, with a legend that gives the numbers back.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "io/image.h"
#include "math/vec3.h"

namespace portalens {

struct ValueRange {
  double low = 0.0, high = 1.0;
};

/// Dark blue over violet, red and orange to pale yellow; its lightness rises all the way, so it
/// reads in gray, too. Linear.
/// @param share  0 to 1; clamped
[[nodiscard]] Rgb heat_color(double share);

/// A colour of its own for each whole number: 0 is dark gray, neighbours differ strongly. Linear.
[[nodiscard]] Rgb number_color(int number);

/// A plane of numbers.
struct Plane {
  int width = 0, height = 0;
  std::vector<float> values;
};

/// The plane in `heat_color`, with a bar and five numbers to its right. Numbers outside the range
/// get the colour of its end; where `absent` is given, values from it on are black.
[[nodiscard]] Image heat_picture(const Plane& plane, const ValueRange& range, double absent);

/// Numbers of three axes as red, green and blue: from 0 at the range's low end to 1 at its high
/// end. The legend has a bar for each.
/// @param axes  of x, y and z, each of `width` x `height`
[[nodiscard]] Image axes_picture(int width, int height,
                                 const std::array<std::span<const float>, 3>& axes,
                                 const ValueRange& range);

/// A name for a number in a legend.
struct NumberName {
  int number = 0;
  std::string name;
};

/// The plane, rounded, in `number_color`; the legend has the names in their order, as many as there
/// is room for.
[[nodiscard]] Image number_picture(const Plane& plane, const std::vector<NumberName>& names);

/// Three linear planes for `write_image`.
[[nodiscard]] std::vector<Channel> color_channels(const Image& image);

}  // namespace portalens
