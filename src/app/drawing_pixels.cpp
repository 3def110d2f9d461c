#include "app/drawing_pixels.h"

#include <algorithm>
#include <cmath>

#include "app/small_letters.h"
#include "io/srgb.h"

namespace portalens {
namespace {

/// Pixels of a letter's pixel.
constexpr int letter_scale = 2;

/// Distance from a point to the segment from a to b.
double distance(DrawingPoint p, DrawingPoint a, DrawingPoint b) {
  const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
  const double along = (p.x - a.x) * dx + (p.y - a.y) * dy;
  const double share = square > 0.0 ? std::clamp(along / square, 0.0, 1.0) : 0.0;
  return std::hypot(p.x - a.x - share * dx, p.y - a.y - share * dy);
}

/// Columns of a letter, from the rows that `letter_of` gives.
int columns_of(std::string_view letter) { return static_cast<int>(letter.find('|')); }

class Painter {
 public:
  explicit Painter(Image& image) : image_(image) {}

  void paint(const InkCells& cells) {
    for (int row = 0; row < cells.rows; ++row)
      for (int column = 0; column < cells.columns; ++column)
        fill(cells.corner.x + column * cells.size, cells.corner.y + row * cells.size, cells.size,
             cells.inks[static_cast<std::size_t>(row) * cells.columns + column]);
  }

  void paint(const Stroke& stroke) {
    const double half = 0.5 * stroke.width;
    for (std::size_t i = 1; i < stroke.points.size(); ++i) {
      const DrawingPoint a = stroke.points[i - 1], b = stroke.points[i];
      cover({std::min(a.x, b.x) - half, std::min(a.y, b.y) - half},
            {std::max(a.x, b.x) + half, std::max(a.y, b.y) + half}, stroke.ink,
            [&](DrawingPoint p) { return half - distance(p, a, b); });
    }
  }

  void paint(const Disc& disc) {
    const DrawingPoint c = disc.center;
    const double r = disc.radius;
    cover({c.x - r, c.y - r}, {c.x + r, c.y + r}, disc.ink,
          [&](DrawingPoint p) { return r - std::hypot(p.x - c.x, p.y - c.y); });
  }

  void paint(const Label& label) {
    int width = 0;
    for (const char c : label.text) width += columns_of(letter_of(c)) + 1;
    const double share = label.anchor == Label::Anchor::begin    ? 0.0
                         : label.anchor == Label::Anchor::middle ? 0.5
                                                                 : 1.0;
    double x = std::round(label.at.x - share * width * letter_scale);
    const double top = std::round(label.at.y) - letter_rows * letter_scale;
    for (const char c : label.text) {
      const std::string_view letter = letter_of(c);
      const int columns = columns_of(letter);
      for (int row = 0; row < letter_rows; ++row)
        for (int column = 0; column < columns; ++column)
          if (letter[static_cast<std::size_t>(row) * (columns + 1) + column] == '#')
            fill(x + column * letter_scale, top + row * letter_scale, letter_scale, label.ink);
      x += (columns + 1) * letter_scale;
    }
  }

 private:
  void blend(int x, int y, Ink ink, double share) {
    const std::uint8_t levels[] = {ink.red, ink.green, ink.blue};
    float* const pixel = image_.at(x, y);
    for (int i = 0; i < 3; ++i) {
      const auto value = static_cast<float>(linear_from_srgb(levels[i] / 255.0));
      pixel[i] += (value - pixel[i]) * static_cast<float>(share);
    }
  }

  void fill(double x, double y, double size, Ink ink) {
    const int x0 = std::max(0, static_cast<int>(x)), y0 = std::max(0, static_cast<int>(y));
    const int x1 = std::min(image_.width, static_cast<int>(x + size));
    const int y1 = std::min(image_.height, static_cast<int>(y + size));
    for (int j = y0; j < y1; ++j)
      for (int i = x0; i < x1; ++i) blend(i, j, ink, 1.0);
  }

  /// Blends where `depth`, how deep a point lies within the mark, is positive, and softly at its
  /// edge.
  template <class Depth>
  void cover(DrawingPoint low, DrawingPoint high, Ink ink, const Depth& depth) {
    const auto index = [](double v, int end) {
      return static_cast<int>(std::clamp(v, 0.0, static_cast<double>(end)));
    };
    const int x1 = index(high.x + 2.0, image_.width), y1 = index(high.y + 2.0, image_.height);
    for (int y = index(low.y - 1.0, image_.height); y < y1; ++y)
      for (int x = index(low.x - 1.0, image_.width); x < x1; ++x) {
        const double share = std::clamp(depth({x + 0.5, y + 0.5}) + 0.5, 0.0, 1.0);
        if (share > 0.0) blend(x, y, ink, share);
      }
  }

  Image& image_;
};

}  // namespace

Image pixels_of(const Drawing& drawing) {
  Image image(drawing.width, drawing.height, 3);
  std::fill(image.pixels.begin(), image.pixels.end(), 1.0f);
  Painter painter(image);
  for (const Mark& mark : drawing.marks) std::visit([&](const auto& m) { painter.paint(m); }, mark);
  return image;
}

}  // namespace portalens
