#include "app/canvas.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "app/stroke_font.h"

namespace portalens {
namespace {

double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }

/// Which share of each pixel one mark covers. Pieces that overlap cover no more than one.
class Coverage {
 public:
  Coverage(int width, int height)
      : width_(width), height_(height), share_(static_cast<std::size_t>(width) * height) {}

  /// A line with round ends.
  void add_segment(Point a, Point b, double width) {
    const double half = std::max(0.5 * width, 0.35), reach = half + 1.0;
    // Hairlines fade instead of growing thinner than a pixel can show.
    const double most = std::min(1.0, width / 0.7);
    const Point along = b - a;
    const double length2 = dot(along, along);
    for (int y = row(std::min(a.y, b.y) - reach); y <= row(std::max(a.y, b.y) + reach); ++y) {
      const auto [low, high] = span_near(a, b, y + 0.5, reach);
      for (int x = column(low); x <= column(high); ++x) {
        const Point p = Point{x + 0.5, y + 0.5} - a;
        const double t = length2 > 0.0 ? std::clamp(dot(p, along) / length2, 0.0, 1.0) : 0.0;
        const Point off = p - along * t;
        const double covered = std::min(half + 0.5 - std::sqrt(dot(off, off)), 1.0);
        if (covered > 0.0) put(x, y, most * covered);
      }
    }
  }

  /// The ring between two radii.
  void add_ring(Point center, double inner, double outer) {
    const double reach = outer + 1.0;
    for (int y = row(center.y - reach); y <= row(center.y + reach); ++y)
      for (int x = column(center.x - reach); x <= column(center.x + reach); ++x) {
        const Point off = Point{x + 0.5, y + 0.5} - center;
        const double distance = std::sqrt(dot(off, off));
        double covered = std::min(outer + 0.5 - distance, 1.0);
        if (inner > 0.0) covered = std::min(covered, distance - inner + 0.5);
        if (covered > 0.0) put(x, y, covered);
      }
  }

  /// A polygon, by the even-odd rule.
  void add_polygon(const PointChain& corners) {
    if (corners.size() < 3) return;
    double low = corners[0].y, high = low;
    for (const Point& corner : corners) {
      low = std::min(low, corner.y);
      high = std::max(high, corner.y);
    }
    std::vector<double> sums(static_cast<std::size_t>(width_));
    for (int y = row(low); y <= row(high); ++y) {
      std::fill(sums.begin(), sums.end(), 0.0);
      for (int line = 0; line < sublines; ++line)
        add_line(corners, y + (line + 0.5) / sublines, sums);
      for (int x = 0; x < width_; ++x)
        if (sums[x] > 0.0) put(x, y, std::min(1.0, sums[x] / sublines));
    }
  }

  /// Lays the color over the picture where something was added, and forgets it.
  void blend(const Color& color, Image& image) {
    const double rgb[] = {color.red, color.green, color.blue};
    for (const std::size_t i : touched_) {
      const double share = color.alpha * share_[i];
      for (std::size_t c = 0; c < 3; ++c) {
        float& value = image.pixels[3 * i + c];
        value = static_cast<float>(value + (rgb[c] - value) * share);
      }
      share_[i] = 0.0f;
    }
    touched_.clear();
  }

 private:
  static constexpr int sublines = 5;

  [[nodiscard]] int row(double y) const {
    return static_cast<int>(std::clamp(std::floor(y), 0.0, height_ - 1.0));
  }
  [[nodiscard]] int column(double x) const {
    return static_cast<int>(std::clamp(std::floor(x), 0.0, width_ - 1.0));
  }

  void put(int x, int y, double covered) {
    const std::size_t i = static_cast<std::size_t>(y) * width_ + x;
    if (share_[i] == 0.0f) touched_.push_back(i);
    share_[i] = std::max(share_[i], static_cast<float>(covered));
  }

  /// Where on the row at `y` the segment is not farther than `reach`, and perhaps a little more.
  [[nodiscard]] static std::pair<double, double> span_near(Point a, Point b, double y,
                                                           double reach) {
    double low = std::min(a.x, b.x), high = std::max(a.x, b.x);
    if (std::fabs(b.y - a.y) > 1e-9) {
      const auto at = [&](double v) {
        return a.x + (b.x - a.x) * std::clamp((v - a.y) / (b.y - a.y), 0.0, 1.0);
      };
      const double one = at(y - reach), other = at(y + reach);
      low = std::min(one, other), high = std::max(one, other);
    }
    return {low - reach, high + reach};
  }

  /// Adds what the polygon covers of one line through the pixels of a row.
  void add_line(const PointChain& corners, double y, std::vector<double>& sums) {
    crossings_.clear();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Point a = corners[i], b = corners[(i + 1) % corners.size()];
      if ((a.y <= y) != (b.y <= y))
        crossings_.push_back(a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)));
    }
    std::sort(crossings_.begin(), crossings_.end());
    for (std::size_t i = 0; i + 1 < crossings_.size(); i += 2) {
      const double from = std::max(crossings_[i], 0.0);
      const double to = std::min(crossings_[i + 1], static_cast<double>(width_));
      for (int x = column(from); from < to && x <= column(to); ++x)
        sums[x] += std::max(0.0, std::min(to, x + 1.0) - std::max(from, static_cast<double>(x)));
    }
  }

  int width_, height_;
  std::vector<float> share_;
  std::vector<std::size_t> touched_;
  std::vector<double> crossings_;
};

struct Painter {
  Image& image;
  Coverage& coverage;
  Color background;

  void lines(const std::vector<PointChain>& pieces, const Stroke& stroke) const {
    for (const PointChain& piece : pieces) {
      double walked = 0.0;
      for (std::size_t i = 1; i < piece.size(); ++i) {
        if (stroke.dash > 0.0)
          dashes(piece[i - 1], piece[i], stroke, walked);
        else
          coverage.add_segment(piece[i - 1], piece[i], stroke.width);
      }
    }
    coverage.blend(stroke.color, image);
  }

  /// The dashes of one segment, of a line of which so much was walked.
  void dashes(Point a, Point b, const Stroke& stroke, double& walked) const {
    const Point along = b - a;
    const double length = std::sqrt(dot(along, along)), period = 2.0 * stroke.dash;
    for (double at = -std::fmod(walked, period); at < length; at += period) {
      const double from = std::max(at, 0.0), to = std::min(at + stroke.dash, length);
      if (from < to)
        coverage.add_segment(a + along * (from / length), a + along * (to / length), stroke.width);
    }
    walked += length;
  }

  void operator()(const Lines& mark) const {
    if (mark.stroke.width > 0.0) lines(mark.pieces, mark.stroke);
  }
  void operator()(const Area& mark) const {
    coverage.add_polygon(mark.corners);
    coverage.blend(mark.color, image);
  }
  void operator()(const Disc& mark) const {
    coverage.add_ring(mark.center, 0.0, mark.radius);
    coverage.blend(mark.color, image);
    if (mark.rim.width <= 0.0) return;
    const double half = 0.5 * mark.rim.width;
    coverage.add_ring(mark.center, mark.radius - half, mark.radius + half);
    coverage.blend(mark.rim.color, image);
  }
  void operator()(const Cells& mark) const {
    const auto edge = [](double corner, double size, int i, int most) {
      return static_cast<int>(std::clamp(corner + i * size, 0.0, static_cast<double>(most)));
    };
    for (int row = 0; row < mark.rows; ++row)
      for (int column = 0; column < mark.columns; ++column) {
        const Color& color = mark.colors[static_cast<std::size_t>(row) * mark.columns + column];
        const float rgb[] = {static_cast<float>(color.red), static_cast<float>(color.green),
                             static_cast<float>(color.blue)};
        const int x1 = edge(mark.corner.x, mark.size, column + 1, image.width);
        const int y1 = edge(mark.corner.y, mark.size, row + 1, image.height);
        for (int y = edge(mark.corner.y, mark.size, row, image.height); y < y1; ++y)
          for (int x = edge(mark.corner.x, mark.size, column, image.width); x < x1; ++x)
            std::copy(rgb, rgb + 3, image.at(x, y));
      }
  }
  void operator()(const Label& mark) const {
    const std::vector<PointChain> letters = letter_lines(mark);
    const double weight = letter_weight(mark.size);
    lines(letters, {background, weight + 3.0});
    lines(letters, {mark.color, weight});
  }
};

}  // namespace

Image rasterized(const Drawing& drawing) {
  Image image(drawing.width, drawing.height, 3);
  const float rgb[] = {static_cast<float>(drawing.background.red),
                       static_cast<float>(drawing.background.green),
                       static_cast<float>(drawing.background.blue)};
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = rgb[i % 3];
  Coverage coverage(drawing.width, drawing.height);
  for (const Mark& mark : drawing.marks)
    std::visit(Painter{image, coverage, drawing.background}, mark);
  return image;
}

}  // namespace portalens
