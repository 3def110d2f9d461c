#include "app/sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace portalens {
namespace {

constexpr std::size_t max_busy = 20000;  ///< points that labels look out for

double length_of(Point p) { return std::sqrt(p.x * p.x + p.y * p.y); }

}  // namespace

Mark arrow_head(Point tip, Point way, double size, const Color& color, const std::string& meaning) {
  const double length = length_of(way);
  if (length < 1e-6) return Disc{tip, 0.3 * size, color, {}, meaning};
  const Point along = way * (size / length), across{-along.y * 0.38, along.x * 0.38};
  const Point back = tip - along;
  return Area{{tip, back + across, back + along * 0.2, back - across}, color, meaning};
}

Sheet::Sheet(const View& view)
    : view_(view), unit_(std::sqrt(static_cast<double>(view.width()) * view.height()) / 720.0) {
  drawing_.width = view.width();
  drawing_.height = view.height();
}

void Sheet::add_lines(const std::vector<std::vector<Vec3d>>& lines, Stroke stroke,
                      const std::string& meaning) {
  Lines mark{{}, stroke, meaning};
  mark.stroke.width *= unit_;
  mark.stroke.dash *= unit_;
  for (const std::vector<Vec3d>& line : lines)
    for (PointChain& piece : view_.project_line(line)) mark.pieces.push_back(std::move(piece));
  if (!mark.pieces.empty()) add(std::move(mark));
}

void Sheet::add_area(std::span<const Vec3d> corners, const Color& color,
                     const std::string& meaning) {
  PointChain seen = view_.project_area(corners);
  if (seen.size() >= 3) add(Area{std::move(seen), color, meaning});
}

void Sheet::add_arrow(Vec3d from, Vec3d to, const Color& color, const std::string& meaning) {
  add_lines({{from, to}}, {color, 1.6}, meaning);
  const auto tip = view_.project(to), tail = view_.project(from);
  if (tip && tail) add(arrow_head(*tip, *tip - *tail, 9.0 * unit_, color, meaning));
}

void Sheet::add_label(Point beside, double distance, const std::string& text, const Color& color,
                      const std::string& meaning, double size_share, Anchor anchor) {
  Label label{beside, text, font() * size_share, color, anchor, meaning};
  wishes_.push_back({beside, distance * unit_, std::move(label)});
}

void Sheet::keep_free(Point point) {
  if (busy_.size() < max_busy) busy_.push_back(point);
}

double Sheet::cost(const Rectangle& place) const {
  double cost = 0.0;
  if (place.left < 2.0 || place.top < 2.0 || place.right > view_.width() - 2.0 ||
      place.bottom > view_.height() - 2.0)
    cost += 400.0;
  for (const Rectangle& other : taken_)
    if (place.left < other.right && other.left < place.right && place.top < other.bottom &&
        other.top < place.bottom)
      cost += 100.0;
  for (const Point& point : busy_)
    if (place.holds(point)) cost += 1.0;
  return cost;
}

void Sheet::place(const Wish& wish) {
  // To the right first, then round; then the same farther away.
  constexpr std::array<Point, 8> ways = {
      {{1, 0}, {0.7, -0.7}, {-1, 0}, {0.7, 0.7}, {0, -1}, {0, 1}, {-0.7, -0.7}, {-0.7, 0.7}}};
  Label label = wish.label;
  const double width = text_width(label.text, label.size), height = 0.75 * label.size;
  double least = std::numeric_limits<double>::infinity();
  Rectangle best{};
  const auto consider = [&](Point middle) {
    const Rectangle place{middle.x - 0.5 * width, middle.y - 0.5 * height, middle.x + 0.5 * width,
                          middle.y + 0.5 * height};
    const double price = cost(place);
    if (price >= least) return;
    least = price;
    best = place;
  };
  if (label.anchor == Anchor::middle) consider(wish.beside);
  label.anchor = Anchor::start;
  for (const double farther : {1.0, 2.2})
    for (const Point& way : ways) {
      const Point middle =
          wish.beside + way * (wish.distance * farther) +
          Point{0.5 * width * way.x / std::max(std::fabs(way.x), 0.7), 0.5 * height * way.y};
      consider(middle);
    }
  label.at = {best.left, best.bottom};
  const double room = 0.15 * label.size;
  taken_.push_back({best.left - room, best.top - room, best.right + room, best.bottom + room});
  add(std::move(label));
}

Drawing Sheet::release() && {
  for (const Wish& wish : wishes_) place(wish);
  return std::move(drawing_);
}

}  // namespace portalens
