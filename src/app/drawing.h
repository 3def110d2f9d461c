/// \file
/// A picture as a list of lines, areas, discs and words, in pixels: what both the SVG writer
/// (drawing_svg.h) and the rasteriser (canvas.h) draw from, so that they show the same.
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "math/vec3.h"

namespace portalens {

/// x to the right, y downwards, from the top left corner; the first pixel's centre is (0.5, 0.5).
struct Point {
  double x = 0, y = 0;
  friend constexpr Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
  friend constexpr Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
  friend constexpr Point operator*(Point a, double s) { return {a.x * s, a.y * s}; }
  friend constexpr bool operator==(const Point&, const Point&) = default;
};

using PointChain = std::vector<Point>;

/// sRGB, each 0 to 1.
struct Color {
  double red = 0, green = 0, blue = 0;
  double alpha = 1;
  friend constexpr bool operator==(const Color&, const Color&) = default;
  [[nodiscard]] constexpr Color with_alpha(double a) const { return {red, green, blue, a}; }
};

/// @param linear  each is taken as 0 to 1
[[nodiscard]] Color color_from_linear(const Rgb& linear);
[[nodiscard]] Rgb linear_from_color(const Color& color);

struct Stroke {
  Color color;
  double width = 0.0;  ///< 0: nothing is drawn
  double dash = 0.0;   ///< length of dashes, and of the gaps between; 0: none
};

/// Lines of one kind, with round ends. `meaning` is the class in SVG: words of letters, digits, -.
struct Lines {
  std::vector<PointChain> pieces;
  Stroke stroke;
  std::string meaning;
};

/// A filled polygon.
struct Area {
  PointChain corners;
  Color color;
  std::string meaning;
};

struct Disc {
  Point center;
  double radius = 1.0;
  Color color;
  Stroke rim;
  std::string meaning;
};

enum class Anchor { start, middle, end };

/// Words with a thin halo, so that they can be read over lines. UTF-8; the rasteriser has letters
/// for ASCII alone, and draws a box for each other one.
struct Label {
  Point at;  ///< on the baseline
  std::string text;
  double size = 13.0;  ///< of the font, pixels
  Color color;
  Anchor anchor = Anchor::start;
  std::string meaning;
};

/// A rectangle of equal square cells, row by row from the top left.
struct Cells {
  Point corner;
  double size = 1.0;
  int columns = 0, rows = 0;
  std::vector<Color> colors;
  std::string meaning;
};

using Mark = std::variant<Lines, Area, Disc, Label, Cells>;

struct Drawing {
  int width = 0, height = 0;
  Color background{1, 1, 1};
  std::vector<Mark> marks;  ///< later ones over earlier ones
};

/// How wide the rasteriser sets a text, pixels; usual fonts set it no wider.
[[nodiscard]] double text_width(const std::string& text, double size);

/// Whether the suffix is a drawing's: .svg or .png.
[[nodiscard]] bool is_drawing_file(const std::filesystem::path& file);

/// Whether a drawing can be written under this name, by its suffix and its place.
/// @throws SceneError if the suffix is another; WorkError if the place can't be written
void check_drawable(const std::filesystem::path& file);

/// Writes SVG or PNG, as the suffix says.
/// @throws as check_drawable
void write_drawing(const std::filesystem::path& file, const Drawing& drawing);

}  // namespace portalens
