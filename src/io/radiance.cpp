#include "io/radiance.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "io/radiance_header.h"
#include "io/radiance_lines.h"

namespace portalens {
namespace {

using Values = std::array<double, 3>;

/// IEC 61966-2-1 with the white of D65: CIE XYZ to the primaries of Rec. 709.
Values rgb_of_xyz(const Values& xyz) {
  constexpr Values rows[] = {{3.2404542, -1.5371385, -0.4985314},
                             {-0.9692660, 1.8760108, 0.0415560},
                             {0.0556434, -0.2040259, 1.0572252}};
  Values rgb{};
  for (std::size_t c = 0; c < 3; ++c)
    rgb[c] = rows[c][0] * xyz[0] + rows[c][1] * xyz[1] + rows[c][2] * xyz[2];
  return rgb;
}

/// m/256 times 2^(e - 128); the exponent 0 is black.
Values values_of(const SharedExponent& pixel, const RadianceHeader& header) {
  Values values{};
  if (pixel[3] == 0) return values;
  const double unit = std::ldexp(1.0, pixel[3] - (128 + 8));
  for (std::size_t c = 0; c < 3; ++c) values[c] = pixel[c] * unit / header.multiplied[c];
  return header.colors == RadianceColors::xyz ? rgb_of_xyz(values) : values;
}

/// The place of pixel `along` of line `line`.
float* place_of(int line, int along, const RadianceHeader& header, Image& image) {
  const int x = header.by_columns ? line : along, y = header.by_columns ? along : line;
  return image.at(header.right_to_left ? image.width - 1 - x : x,
                  header.bottom_up ? image.height - 1 - y : y);
}

}  // namespace

Image read_radiance(std::string_view bytes) {
  const RadianceHeader header = radiance_header(bytes);
  Image image(static_cast<int>(header.width), static_cast<int>(header.height), 3);
  const int lines = header.by_columns ? image.width : image.height;
  const int length = header.by_columns ? image.height : image.width;
  RadianceLines coded(bytes.substr(header.size));
  std::vector<SharedExponent> line(static_cast<std::size_t>(length));
  for (int i = 0; i < lines; ++i) {
    coded.read(line);
    for (int j = 0; j < length; ++j) {
      const Values values = values_of(line[static_cast<std::size_t>(j)], header);
      float* const pixel = place_of(i, j, header, image);
      for (std::size_t c = 0; c < 3; ++c) pixel[c] = static_cast<float>(values[c]);
    }
  }
  return image;
}

}  // namespace portalens
