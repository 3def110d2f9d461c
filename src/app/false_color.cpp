#include "app/false_color.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>

#include "math/srgb.h"

namespace portalens {
namespace {

constexpr int glyph_width = 3, glyph_height = 5,
              dot_size = 2;  // a glyph's dots are squares of pixels
constexpr int legend_width = 128, bar_width = 18, gap = 8;
constexpr int line_height = (glyph_height + 3) * dot_size;

struct Glyph {
  char letter;
  std::string_view dots;  ///< row by row
};

constexpr Glyph glyphs[] = {
    {'0', "####.##.##.####"}, {'1', ".#.##..#..#.###"}, {'2', "###..#####..###"},
    {'3', "###..####..####"}, {'4', "#.##.####..#..#"}, {'5', "####..###..####"},
    {'6', "####..####.####"}, {'7', "###..#..#..#..#"}, {'8', "####.#####.####"},
    {'9', "####.####..####"}, {'-', "......###......"}, {'+', "....#.###.#...."},
    {'.', ".............#."}, {'A', ".#.#.#####.##.#"}, {'B', "##.#.###.#.###."},
    {'C', ".###..#..#...##"}, {'D', "##.#.##.##.###."}, {'E', "####..##.#..###"},
    {'F', "####..##.#..#.."}, {'G', ".###..#.##.#.##"}, {'H', "#.##.#####.##.#"},
    {'I', "###.#..#..#.###"}, {'J', "..#..#..##.#.#."}, {'K', "#.##.###.#.##.#"},
    {'L', "#..#..#..#..###"}, {'M', "#.#####.##.##.#"}, {'N', "##.#.##.##.##.#"},
    {'O', ".#.#.##.##.#.#."}, {'P', "##.#.###.#..#.."}, {'Q', ".#.#.##.#.#...#"},
    {'R', "##.#.###.#.##.#"}, {'S', ".###...#...###."}, {'T', "###.#..#..#..#."},
    {'U', "#.##.##.##.####"}, {'V', "#.##.##.##.#.#."}, {'W', "#.##.##.#####.#"},
    {'X', "#.##.#.#.#.##.#"}, {'Y', "#.##.#.#..#..#."}, {'Z', "###..#.#.#..###"}};

void set(Image& image, int x, int y, Rgb color) {
  if (x < 0 || y < 0 || x >= image.width || y >= image.height) return;
  float* pixel = image.at(x, y);
  pixel[0] = static_cast<float>(color.x);
  pixel[1] = static_cast<float>(color.y);
  pixel[2] = static_cast<float>(color.z);
}

void fill(Image& image, int x, int y, int width, int height, Rgb color) {
  for (int j = y; j < y + height; ++j)
    for (int i = x; i < x + width; ++i) set(image, i, j, color);
}

/// Capitals, digits and signs in white; anything else is left blank.
void write(Image& image, int x, int y, std::string_view text) {
  for (const char c : text) {
    const char letter = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    const auto glyph = std::find_if(std::begin(glyphs), std::end(glyphs),
                                    [&](const Glyph& one) { return one.letter == letter; });
    if (glyph != std::end(glyphs))
      for (int i = 0; i < glyph_width * glyph_height; ++i)
        if (glyph->dots[static_cast<std::size_t>(i)] == '#')
          fill(image, x + i % glyph_width * dot_size, y + i / glyph_width * dot_size, dot_size,
               dot_size, {1, 1, 1});
    x += (glyph_width + 1) * dot_size;
  }
}

Rgb from_srgb(double red, double green, double blue) {
  const auto linear = [](double v) {
    return static_cast<double>(linear_from_srgb(static_cast<float>(v)));
  };
  return {linear(red), linear(green), linear(blue)};
}

/// Room for the picture, and a legend to its right.
Image canvas(const Plane& plane, int legend = legend_width, int lines = 6) {
  return Image(plane.width + legend, std::max(plane.height, lines * line_height), 3);
}

/// How many pixels a legend with these names takes.
int width_for(const std::vector<NumberName>& names) {
  constexpr std::size_t longest = 32;  // of the letters of a name that are shown
  std::size_t letters = 0;
  for (const NumberName& entry : names) letters = std::max(letters, entry.name.size());
  const int text = static_cast<int>(std::min(letters, longest)) * (glyph_width + 1) * dot_size;
  return std::max(legend_width, 3 * gap + bar_width + text);
}

template <class ColorOf>
void paint(Image& image, const Plane& plane, const ColorOf& color_of) {
  for (int y = 0; y < plane.height; ++y)
    for (int x = 0; x < plane.width; ++x)
      set(image, x, y,
          color_of(
              plane.values[static_cast<std::size_t>(y) * static_cast<std::size_t>(plane.width) +
                           static_cast<std::size_t>(x)]));
}

}  // namespace

Rgb heat_color(double share) {
  constexpr std::array<std::array<double, 3>, 7> stops = {{{0.02, 0.03, 0.16},
                                                           {0.22, 0.07, 0.42},
                                                           {0.51, 0.12, 0.48},
                                                           {0.80, 0.22, 0.36},
                                                           {0.96, 0.45, 0.20},
                                                           {0.99, 0.73, 0.25},
                                                           {0.99, 0.98, 0.75}}};
  const double at = std::clamp(std::isnan(share) ? 0.0 : share, 0.0, 1.0) * (stops.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(at), stops.size() - 2);
  const double t = at - static_cast<double>(i);
  const auto mix = [&](std::size_t c) { return stops[i][c] + (stops[i + 1][c] - stops[i][c]) * t; };
  return from_srgb(mix(0), mix(1), mix(2));
}

Rgb number_color(int number) {
  if (number == 0) return from_srgb(0.25, 0.25, 0.25);
  // Hues by the golden section: neighbours lie far apart, and none comes back soon.
  const double hue = 6.0 * (number * 0.6180339887498949 - std::floor(number * 0.6180339887498949));
  const auto wave = [&](double from) {
    const double distance = std::fabs(std::remainder(hue - from, 6.0));
    return 0.25 + 0.7 * std::clamp(2.0 - distance, 0.0, 1.0);
  };
  return from_srgb(wave(0.0), wave(2.0), wave(4.0));
}

Image heat_picture(const Plane& plane, const ValueRange& range, double absent) {
  Image image = canvas(plane);
  const double span = range.high - range.low;
  paint(image, plane, [&](double value) {
    if (value >= absent) return Rgb{};
    return heat_color(span > 0.0 ? (value - range.low) / span : 0.5);
  });
  const int left = plane.width + gap, top = line_height, bottom = image.height - line_height;
  for (int y = top; y < bottom; ++y)
    fill(image, left, y, bar_width, 1, heat_color(1.0 - (y - top) / double(bottom - 1 - top)));
  for (int tick = 0; tick < 5; ++tick) {
    const double share = tick / 4.0;
    const int y = bottom - 1 - static_cast<int>(std::lround(share * (bottom - 1 - top)));
    fill(image, left + bar_width, y, 4, 1, {1, 1, 1});
    write(image, left + bar_width + gap, y - glyph_height * dot_size / 2,
          fmt::format("{:.4g}", range.low + share * span));
  }
  return image;
}

Image axes_picture(int width, int height, const std::array<std::span<const float>, 3>& axes,
                   const ValueRange& range) {
  Image image(width + legend_width, std::max(height, 6 * line_height), 3);
  const double span = range.high > range.low ? range.high - range.low : 1.0;
  const auto share = [&](float value) { return (value - range.low) / span; };
  for (std::size_t i = 0; i < axes[0].size(); ++i)
    set(image, static_cast<int>(i % static_cast<std::size_t>(width)),
        static_cast<int>(i / static_cast<std::size_t>(width)),
        {share(axes[0][i]), share(axes[1][i]), share(axes[2][i])});
  const int top = 2 * line_height, bottom = image.height - line_height;
  constexpr int letter = glyph_width * dot_size;
  for (int axis = 0; axis < 3; ++axis) {
    const int left = width + gap + axis * (bar_width + gap) / 2;
    const Rgb color{axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0};
    write(image, left, top - line_height, std::string_view("XYZ").substr(axis, 1));
    for (int y = top; y < bottom; ++y)
      fill(image, left, y, letter, 1, color * (1.0 - (y - top) / double(bottom - 1 - top)));
  }
  const int beside = width + 2 * gap + 3 * (bar_width + gap) / 2;
  write(image, beside, top, fmt::format("{:.4g}", range.high));
  write(image, beside, bottom - glyph_height * dot_size, fmt::format("{:.4g}", range.low));
  return image;
}

Image number_picture(const Plane& plane, const std::vector<NumberName>& names) {
  Image image = canvas(plane, width_for(names), static_cast<int>(names.size()) + 2);
  paint(image, plane,
        [](double value) { return number_color(static_cast<int>(std::lround(value))); });
  int y = line_height;
  for (const NumberName& entry : names) {
    if (y + line_height > image.height) break;
    fill(image, plane.width + gap, y, bar_width, glyph_height * dot_size,
         number_color(entry.number));
    write(image, plane.width + 2 * gap + bar_width, y, entry.name);
    y += line_height;
  }
  return image;
}

std::vector<Channel> color_channels(const Image& image) {
  std::vector<Channel> channels = {{"R", {}}, {"G", {}}, {"B", {}}};
  for (std::size_t channel = 0; channel < 3; ++channel)
    for (std::size_t i = channel; i < image.pixels.size(); i += 3)
      channels[channel].values.push_back(image.pixels[i]);
  return channels;
}

}  // namespace portalens
