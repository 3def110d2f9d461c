#include "app/field_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "app/portal_color.h"
#include "photon/field_parts.h"
#include "render/parallel.h"

namespace portalens {
namespace {

constexpr double cell_size = 2.0;
constexpr double arrow_spacing = 40.0;
constexpr int legend_rows = 72;
constexpr double letters = 14.0;       ///< size of the font
constexpr double label_height = 10.0;  ///< of its capitals

constexpr Color of_bytes(int red, int green, int blue) {
  return {red / 255.0, green / 255.0, blue / 255.0};
}
constexpr Color black, dark = of_bytes(60, 60, 60), way_color = of_bytes(20, 130, 50),
                       grey = of_bytes(225, 225, 225);
/// A scale of colours for 0 <= share <= 1, in so many steps that a drawing in SVG stays small.
Color color_of(double share) {
  constexpr double stops[][3] = {
      {238, 244, 251}, {185, 215, 234}, {247, 232, 168}, {244, 178, 102}, {224, 102, 79}};
  constexpr double steps = 32.0;
  const double at = std::round(std::clamp(share, 0.0, 1.0) * steps) / steps * 4.0;
  const int i = std::min(static_cast<int>(at), 3);
  int levels[3];
  for (int k = 0; k < 3; ++k)
    levels[k] =
        static_cast<int>(std::lround(stops[i][k] + (stops[i + 1][k] - stops[i][k]) * (at - i)));
  return of_bytes(levels[0], levels[1], levels[2]);
}

/// Powers of ten between which strengths are told apart; nothing pulls where `high` is not above
/// `low`.
struct Scale {
  double low = 0.0, high = 0.0;

  [[nodiscard]] double share(double strength) const {
    return (std::log10(strength) - low) / (high - low);
  }
};

/// From the weakest hundredth to the strongest, in tenths of a power.
Scale scale_of(const std::vector<double>& strengths) {
  std::vector<double> powers;
  for (const double strength : strengths)
    if (strength > 0.0 && std::isfinite(strength)) powers.push_back(std::log10(strength));
  if (powers.empty()) return {};
  std::sort(powers.begin(), powers.end());
  const std::size_t edge = powers.size() / 100;
  Scale scale{std::floor(10.0 * powers[edge]) / 10.0,
              std::ceil(10.0 * powers[powers.size() - 1 - edge]) / 10.0};
  if (scale.high <= scale.low) scale.high = scale.low + 0.1;
  return scale;
}

class FieldArtist {
 public:
  FieldArtist(const Space& space, const FieldPlane& plane, const FieldDrawingOptions& options)
      : space_(space),
        plane_(plane),
        options_(options),
        across_(normalize(plane.right)),
        upwards_(normalize(plane.up)),
        scale_(options.width / length(plane.right)) {
    drawing_.width = options.width;
    rows_ = std::max(1, static_cast<int>(std::lround(scale_ * length(plane.up))));
    drawing_.height = rows_ + legend_rows;
  }

  Drawing draw() && {
    paint_strength();
    if (options_.ways != DrawnWays::none) draw_ways();
    draw_arrows();
    draw_portals();
    draw_masses();
    // What strays below the plane is covered.
    const double width = drawing_.width, top = rows_, bottom = rows_ + legend_rows;
    add(Area{{{0, top}, {width, top}, {width, bottom}, {0, bottom}}, {1, 1, 1}, ""});
    draw_legend();
    return std::move(drawing_);
  }

 private:
  [[nodiscard]] Vec3d place_of(Point p) const {
    return plane_.corner + across_ * (p.x / scale_) + upwards_ * ((rows_ - p.y) / scale_);
  }

  /// Projected onto the plane.
  [[nodiscard]] Point point_of(Vec3d x) const {
    const Vec3d from = x - plane_.corner;
    return {dot(from, across_) * scale_, rows_ - dot(from, upwards_) * scale_};
  }

  void paint_strength() {
    Cells cells;
    cells.size = cell_size;
    cells.columns = static_cast<int>(std::ceil(drawing_.width / cell_size));
    cells.rows = static_cast<int>(std::ceil(rows_ / cell_size));
    const auto columns = static_cast<std::size_t>(cells.columns);
    std::vector<double> strengths(columns * cells.rows);
    parallel_for(
        static_cast<std::size_t>(cells.rows), options_.threads,
        [&](std::size_t row) {
          for (std::size_t column = 0; column < columns; ++column)
            strengths[row * columns + column] =
                length(field_at(space_, place_of({(static_cast<double>(column) + 0.5) * cell_size,
                                                  (static_cast<double>(row) + 0.5) * cell_size})));
        },
        [] { return false; });
    strengths_ = scale_of(strengths);
    for (const double strength : strengths) {
      cells.colors.push_back(strength > 0.0 ? color_of(strengths_.share(strength)) : grey);
      is_partly_free_ = is_partly_free_ || !(strength > 0.0);
    }
    add(std::move(cells));
  }

  /// Calls `visit(point)` on a square grid that begins at `offset`.
  template <class Visit>
  void on_grid(double offset, const Visit& visit) const {
    for (double y = offset; y < rows_; y += arrow_spacing)
      for (double x = offset; x < drawing_.width; x += arrow_spacing) visit(Point{x, y});
  }

  void draw_ways() {
    on_grid(0.0, [&](Point p) {
      std::vector<PullPart> parts = std::visit(
          [&](const auto& coupling) { return coupling.parts(place_of(p)); }, space_.coupling);
      parts.erase(std::remove_if(parts.begin(), parts.end(),
                                 [](const PullPart& part) { return part.portals.size() > 1; }),
                  parts.end());
      std::stable_sort(parts.begin(), parts.end(), [](const PullPart& a, const PullPart& b) {
        return a.distance < b.distance;
      });
      if (options_.ways == DrawnWays::nearest && parts.size() > 1) parts.resize(1);
      for (const PullPart& part : parts) stroke({p, point_of(part.entrance)}, way_color, 1.0);
      if (!parts.empty()) add(Disc{p, 2.0, way_color, {}, "way"});
    });
  }

  /// As long as the part of the direction that lies in the plane.
  void draw_arrows() {
    on_grid(0.5 * arrow_spacing, [&](Point p) {
      const Vec3d field = field_at(space_, place_of(p));
      const double strength = length(field);
      if (!(strength > 0.0) || !std::isfinite(strength)) return;
      const double dx = dot(field, across_) / strength, dy = -dot(field, upwards_) / strength;
      const double half = 0.32 * arrow_spacing;
      const Point tail{p.x - half * dx, p.y - half * dy};
      const Point head{p.x + half * dx, p.y + half * dy};
      stroke({tail, head}, black, 1.3);
      for (const double side : {-1.0, 1.0})
        stroke({head, {head.x - 6.0 * dx + side * 3.0 * dy, head.y - 6.0 * dy - side * 3.0 * dx}},
               black, 1.3);
    });
  }

  void draw_portals() {
    const std::span<const Portal> portals = space_.portals.portals();
    for (std::uint32_t i = 0; i < portals.size(); ++i) {
      const Portal& portal = portals[i];
      const Color ink = portal_color(portals, i);
      PointChain outline;
      for (const Vec3d& vertex : portal.vertices) outline.push_back(point_of(vertex));
      outline.push_back(outline.front());
      stroke(std::move(outline), ink, 1.0);
      draw_cut(portal, ink);
      Point at = point_of(portal.frame.origin);
      const double forwards = dot(portal.frame.normal, across_);
      at.x += 10.0 * forwards;
      at.y += -10.0 * dot(portal.frame.normal, upwards_) + 0.5 * label_height;
      add_name(at, portal.name,
               forwards > 0.3    ? Anchor::start
               : forwards < -0.3 ? Anchor::end
                                 : Anchor::middle);
    }
  }

  /// Where the plane cuts a portal: thick, with teeth on the front.
  void draw_cut(const Portal& portal, const Color& ink) {
    const Vec3d normal = cross(across_, upwards_);
    std::vector<Vec3d> ends;
    const std::size_t count = portal.vertices.size();
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3d a = portal.vertices[i], b = portal.vertices[(i + 1) % count];
      const double from = dot(a - plane_.corner, normal), to = dot(b - plane_.corner, normal);
      if ((from < 0.0) != (to < 0.0)) ends.push_back(a + (b - a) * (from / (from - to)));
    }
    // Along the cut it enters and leaves the face by turns.
    const Vec3d along = cross(normal, portal.frame.normal);
    std::sort(ends.begin(), ends.end(),
              [&](Vec3d a, Vec3d b) { return dot(a, along) < dot(b, along); });
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2)
      draw_toothed(point_of(ends[i]), point_of(ends[i + 1]), portal.frame.normal, ink);
  }

  void draw_toothed(Point a, Point b, Vec3d front, const Color& ink) {
    stroke({a, b}, ink, 4.0);
    const double fx = dot(front, across_), fy = -dot(front, upwards_);
    const double span = std::hypot(b.x - a.x, b.y - a.y);
    const int teeth = std::clamp(static_cast<int>(span / 8.0), 1, 1000);
    for (int i = 0; i < teeth; ++i) {
      const double share = (i + 0.5) / teeth;
      const Point nearest_point{a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
      stroke({nearest_point, {nearest_point.x + 7.0 * fx, nearest_point.y + 7.0 * fy}}, ink, 1.5);
    }
  }

  void draw_masses() {
    for (const Mass& mass : space_.masses) {
      const Point center = point_of(mass.center);
      const double height = dot(mass.center - plane_.corner, cross(across_, upwards_));
      const double influence2 = mass.influence * mass.influence - height * height;
      if (std::isfinite(influence2) && influence2 > 0.0)
        circle(center, std::sqrt(influence2) * scale_, dark);
      add(Disc{center, std::max(4.0, mass.horizon_radius * scale_), black, {}, "mass"});
      add_name({center.x + 8.0, center.y - 8.0}, mass.name, Anchor::start);
    }
  }

  /// A label, below those that it would overlap.
  void add_name(Point at, const std::string& text, Anchor anchor) {
    const auto left = [](const Label& one) {
      const double width = text_width(one.text, letters);
      const double share = one.anchor == Anchor::start ? 0.0
                           : one.anchor == Anchor::end ? 1.0
                                                       : 0.5;
      return one.at.x - share * width;
    };
    Label name{at, text, letters, black, anchor, ""};
    const auto overlaps = [&](const Label& one) {
      return std::fabs(one.at.y - name.at.y) < letters &&
             left(one) < left(name) + text_width(text, letters) &&
             left(name) < left(one) + text_width(one.text, letters);
    };
    constexpr int most = 20;
    for (int i = 0; i < most && std::any_of(names_.begin(), names_.end(), overlaps); ++i)
      name.at.y += letters;
    names_.push_back(name);
    add(std::move(name));
  }

  void circle(Point center, double radius, const Color& ink) {
    PointChain ring;
    constexpr int corners = 180;
    for (int i = 0; i <= corners; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / corners;
      ring.push_back({center.x + radius * std::cos(angle), center.y + radius * std::sin(angle)});
    }
    stroke(std::move(ring), ink, 1.0);
  }

  void draw_legend() {
    const double left = 10.0, right = drawing_.width - 10.0, top = rows_ + 8.0;
    label({left, top + 60.0}, told(plane_), Anchor::start);
    const Physics& physics = space_.physics;
    const std::string what = fmt::format("acceleration; law {}; {}, depth {}", physics.law,
                                         physics.portal_gravity, physics.portal_gravity_depth);
    if (strengths_.high <= strengths_.low) {
      label({left, top + 40.0}, "nothing pulls here: no influence reaches the plane; " + what,
            Anchor::start);
      return;
    }
    label({left, top + 40.0}, what + (is_partly_free_ ? "; grey: nothing pulls" : ""),
          Anchor::start);
    Cells bar;
    bar.corner = {left, top};
    bar.size = 2.0;
    bar.columns = std::max(1, static_cast<int>((right - left) / bar.size));
    bar.rows = 5;
    for (int row = 0; row < bar.rows; ++row)
      for (int column = 0; column < bar.columns; ++column)
        bar.colors.push_back(color_of((column + 0.5) / bar.columns));
    add(std::move(bar));
    const double span = strengths_.high - strengths_.low;
    tick(left, top, strengths_.low, Anchor::start);
    for (double power = std::ceil(strengths_.low); power < strengths_.high; power += 1.0) {
      const double x = left + (power - strengths_.low) / span * (right - left);
      if (x > left + 60.0 && x < right - 60.0) tick(x, top, power, Anchor::middle);
    }
    tick(right, top, strengths_.high, Anchor::end);
  }

  void tick(double x, double top, double power, Anchor anchor) {
    stroke({{x, top}, {x, top + 13.0}}, black, 1.0);
    label({x, top + 25.0}, fmt::format("{:.3g}", std::pow(10.0, power)), anchor);
  }

  void add(Mark mark) { drawing_.marks.push_back(std::move(mark)); }
  void stroke(PointChain points, const Color& color, double width) {
    add(Lines{{std::move(points)}, {color, width}, ""});
  }
  void label(Point at, const std::string& text, Anchor anchor) {
    add(Label{at, text, letters, black, anchor, ""});
  }

  const Space& space_;
  const FieldPlane& plane_;
  const FieldDrawingOptions& options_;
  Vec3d across_, upwards_;
  double scale_;  ///< pixels a length
  int rows_ = 0;  ///< of the plane, above the legend
  Scale strengths_;
  bool is_partly_free_ = false;  ///< somewhere nothing pulls
  std::vector<Label> names_;
  Drawing drawing_;
};

}  // namespace

Drawing draw_field(const Space& space, const FieldPlane& plane,
                   const FieldDrawingOptions& options) {
  return FieldArtist(space, plane, options).draw();
}

}  // namespace portalens
