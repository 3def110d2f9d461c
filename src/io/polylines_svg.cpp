// Ways of photons as an SVG 1.1 plan.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>

#include "io/polylines.h"
#include "io/srgb.h"

namespace portalens {
namespace {

/// Units along the longer side of what is shown.
constexpr double page_size = 1000.0;

struct Place {
  double x = 0.0, y = 0.0;
};

/// On the page: x to the right, y down.
Place on_page(Vec3d v, PlanView view) {
  switch (view) {
    case PlanView::top:
      return {v.x, v.z};
    case PlanView::front:
      return {v.x, -v.y};
    case PlanView::side:
      break;
  }
  return {-v.z, -v.y};
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '&')
      result += "&amp;";
    else
      result += byte < 0x20 || byte >= 0x7f ? '?' : c;
  }
  return result;
}

std::string color_text(Rgb color) {
  const auto byte = [](double linear) {
    return std::lround(255.0 * srgb_from_linear(std::clamp(linear, 0.0, 1.0)));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(color.x), byte(color.y), byte(color.z));
}

/// The smallest rectangle round everything.
class PageFrame {
 public:
  void add(Place p) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) return;
    low_ = empty_ ? p : Place{std::min(low_.x, p.x), std::min(low_.y, p.y)};
    high_ = empty_ ? p : Place{std::max(high_.x, p.x), std::max(high_.y, p.y)};
    empty_ = false;
  }
  [[nodiscard]] double side() const { return std::max({high_.x - low_.x, high_.y - low_.y, 1e-9}); }
  [[nodiscard]] std::string view_box(double scale) const {
    const double margin = 0.1 * side();
    return fmt::format("{:.9g} {:.9g} {:.9g} {:.9g}", scale * (low_.x - margin),
                       scale * (low_.y - margin), scale * (high_.x - low_.x + 2 * margin),
                       scale * (high_.y - low_.y + 2 * margin));
  }

 private:
  Place low_, high_;
  bool empty_ = true;
};

class Plan {
 public:
  Plan(const PathPicture& picture, PlanView view) : picture_(picture), view_(view) {
    // An escaped photon goes far: it may leave the page.
    for (const PathLine& line : picture.lines) {
      const std::size_t shown = line.tail == Vec3d{} ? line.points.size() : 1;
      for (std::size_t i = 0; i < std::min(shown, line.points.size()); ++i)
        frame_.add(on_page(line.points[i], view));
    }
    for (const FlatBody& body : picture.flats)
      for (const Vec3d& vertex : body.vertices) frame_.add(on_page(vertex, view));
    for (const RoundBody& body : picture.balls)
      for (const double sign : {-1.0, 1.0})
        frame_.add(on_page(body.center + Vec3d{1, 1, 1} * (sign * body.radius), view));
  }

  std::string text() {
    scale_ = page_size / frame_.side();
    text_ = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" viewBox=\"{}\">\n"
        "<g fill=\"none\" stroke-width=\"2\" stroke-linejoin=\"round\" font-size=\"20\" "
        "font-family=\"sans-serif\">\n",
        frame_.view_box(scale_));
    for (const RoundBody& body : picture_.balls) ball(body);
    for (const FlatBody& body : picture_.flats) flat(body);
    for (const PathLine& line : picture_.lines) way(line);
    return std::move(text_) + "</g>\n</svg>\n";
  }

 private:
  static std::vector<Vec3d> points_of(const PathLine& line) {
    std::vector<Vec3d> points = line.points;
    if (line.tail != Vec3d{} && !points.empty()) points.push_back(points.back() + line.tail);
    return points;
  }

  [[nodiscard]] Place scaled(Vec3d point) const {
    const Place place = on_page(point, view_);
    return {scale_ * place.x, scale_ * place.y};
  }

  [[nodiscard]] std::string pair(Vec3d point) const {
    const Place place = scaled(point);
    return fmt::format("{:.9g},{:.9g} ", place.x, place.y);
  }

  void label(Vec3d at, const std::string& name, Rgb color) {
    const Place place = scaled(at);
    fmt::format_to(std::back_inserter(text_),
                   "<text x=\"{:.9g}\" y=\"{:.9g}\" fill=\"{}\">{}</text>\n", place.x, place.y,
                   color_text(color), escaped(name));
  }

  void ball(const RoundBody& body) {
    const Place place = scaled(body.center);
    fmt::format_to(std::back_inserter(text_),
                   "<circle cx=\"{:.9g}\" cy=\"{:.9g}\" r=\"{:.9g}\" fill=\"{}\"/>\n", place.x,
                   place.y, scale_ * body.radius, color_text(body.color));
    label(body.center + Vec3d{1, 1, 1} * body.radius, body.name, body.color);
  }

  void flat(const FlatBody& body) {
    text_ += "<polygon points=\"";
    for (const Vec3d& vertex : body.vertices) text_ += pair(vertex);
    text_ += fmt::format("\" stroke=\"{0}\" fill=\"{0}\" fill-opacity=\"0.2\"/>\n",
                         color_text(body.color));
    label(body.vertices.front(), body.name, body.color);
  }

  /// Neighbouring pieces of one colour are drawn as one.
  void way(const PathLine& line) {
    const std::vector<Vec3d> points = points_of(line);
    const auto color = [&](std::size_t i) {
      return color_text(line.colors[std::min(i, line.colors.size() - 1)]);
    };
    for (std::size_t begin = 0; begin + 1 < points.size();) {
      std::size_t end = begin + 1;
      const std::string stroke = color(end);
      std::string list = pair(points[begin]) + pair(points[end]);
      while (end + 1 < points.size() && color(end + 1) == stroke) list += pair(points[++end]);
      text_ += "<polyline points=\"" + list + "\" stroke=\"" + stroke + "\"/>\n";
      begin = end;
    }
  }

  const PathPicture& picture_;
  PlanView view_;
  PageFrame frame_;
  double scale_ = 1.0;
  std::string text_;
};

}  // namespace

std::string paths_as_svg(const PathPicture& picture, PlanView view) {
  return Plan(picture, view).text();
}

}  // namespace portalens
