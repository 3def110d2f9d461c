/// \file
/// A drawing as a list of marks, which can become SVG or pixels. Coordinates are pixels, y
/// downwards, (0, 0) the top left corner.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace portalens {

/// sRGB, 8 bits each.
struct Ink {
  std::uint8_t red = 0, green = 0, blue = 0;

  friend bool operator==(const Ink&, const Ink&) = default;
};

struct DrawingPoint {
  double x = 0.0, y = 0.0;
};

/// A rectangle of equal square cells, row by row from the top left.
struct InkCells {
  DrawingPoint corner;
  double size = 1.0;
  int columns = 0, rows = 0;
  std::vector<Ink> inks;
};

struct Stroke {
  std::vector<DrawingPoint> points;
  Ink ink;
  double width = 1.0;
};

struct Disc {
  DrawingPoint center;
  double radius = 1.0;
  Ink ink;
};

/// One line of text; it ends at `at`, is in its middle, or begins there.
struct Label {
  enum class Anchor : std::uint8_t { begin, middle, end };
  DrawingPoint at;  ///< on the base line
  std::string text;
  Anchor anchor = Anchor::begin;
  Ink ink;
};

using Mark = std::variant<InkCells, Stroke, Disc, Label>;

/// On white; later marks cover earlier ones.
struct Drawing {
  int width = 0, height = 0;
  std::vector<Mark> marks;

  template <class M>
  void add(M mark) {
    marks.emplace_back(std::in_place_type<M>, std::move(mark));
  }
};

/// Height of a label's capitals, pixels.
inline constexpr double label_height = 10.0;

}  // namespace portalens
