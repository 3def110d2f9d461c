#include "app/legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "app/portal_color.h"
#include "app/scene_marks.h"
#include "app/sheet.h"

namespace portalens {
namespace {

constexpr std::size_t max_told = 8;  ///< paths in words

struct LegendEntry {
  std::vector<Mark> symbol;  ///< about (0, 0), within 12 units to both sides
  std::string text;
};

struct Mover {
  Point by;
  void operator()(Lines& mark) const {
    for (PointChain& piece : mark.pieces) move(piece);
  }
  void operator()(Area& mark) const { move(mark.corners); }
  void operator()(Cells& mark) const { mark.corner = mark.corner + by; }
  void operator()(Disc& mark) const { mark.center = mark.center + by; }
  void operator()(Label& mark) const { mark.at = mark.at + by; }
  void move(PointChain& line) const {
    for (Point& point : line) point = point + by;
  }
};

/// Fills the strip row by row.
class Strip {
 public:
  Strip(double unit, Drawing& drawing)
      : unit_(unit), drawing_(drawing), right_(drawing.width - margin()) {
    y_ = drawing.height + margin();
    x_ = margin();
  }

  void add_entry(LegendEntry entry) {
    const double symbol = 30.0 * unit_, width = symbol + text_width(entry.text, font());
    if (x_ > margin() && x_ + width > right_) new_row();
    for (Mark& mark : entry.symbol) {
      std::visit(Mover{{x_ + 0.4 * symbol, y_ + 0.5 * row()}}, mark);
      drawing_.marks.push_back(std::move(mark));
    }
    add_text(x_ + symbol, entry.text, font());
    x_ += width + 22.0 * unit_;
  }

  /// A text of its own rows, cut between words.
  void add_line(const std::string& text, double size_share) {
    if (x_ > margin()) new_row();
    std::string row_text;
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find(' ', begin), text.size());
      const std::string word = text.substr(begin, end - begin);
      const std::string longer = row_text.empty() ? word : row_text + ' ' + word;
      if (!row_text.empty() && margin() + text_width(longer, font() * size_share) > right_) {
        add_text(x_, row_text, font() * size_share);
        new_row();
        x_ = margin() + 20.0 * unit_;
        row_text = word;
      } else {
        row_text = longer;
      }
      begin = end + 1;
    }
    add_text(x_, row_text, font() * size_share);
    new_row();
  }

  /// At the right end of the row.
  void add_scale(double pixels_per_length) {
    const double power = std::pow(10.0, std::floor(std::log10(110.0 * unit_ / pixels_per_length)));
    double best = power;
    for (const double factor : {2.0, 5.0})
      if (factor * power * pixels_per_length <= 110.0 * unit_) best = factor * power;
    const double width = best * pixels_per_length, tick = 3.0 * unit_;
    const double y = y_ + 0.5 * row(), from = right_ - width;
    const Stroke stroke{ink::black, 1.3 * unit_};
    drawing_.marks.push_back(Lines{{{{from, y}, {right_, y}},
                                    {{from, y - tick}, {from, y + tick}},
                                    {{right_, y - tick}, {right_, y + tick}}},
                                   stroke,
                                   "scale"});
    drawing_.marks.push_back(Label{{from - 6.0 * unit_, y_ + 0.5 * row() + 0.35 * font()},
                                   fmt::format("{:g}", best),
                                   font(),
                                   ink::black,
                                   Anchor::end,
                                   "scale"});
  }

  void finish() {
    if (x_ > margin()) new_row();
    drawing_.height = static_cast<int>(std::ceil(y_ + 0.5 * margin()));
  }

 private:
  [[nodiscard]] double font() const { return 12.5 * unit_; }
  [[nodiscard]] double row() const { return 21.0 * unit_; }
  [[nodiscard]] double margin() const { return 14.0 * unit_; }
  void new_row() {
    x_ = margin();
    y_ += row();
  }
  void add_text(double x, const std::string& text, double size) {
    drawing_.marks.push_back(Label{
        {x, y_ + 0.5 * row() + 0.35 * size}, text, size, ink::black, Anchor::start, "legend"});
  }

  double unit_;
  Drawing& drawing_;
  double right_, x_, y_;
};

LegendEntry line_entry(const Stroke& stroke, double unit, const std::string& text) {
  return {{Lines{{{{-11.0 * unit, 0}, {11.0 * unit, 0}}}, stroke, "legend"}}, text};
}

std::vector<LegendEntry> scene_entries(const World& world, const Drawing& drawing, double unit) {
  std::vector<LegendEntry> entries;
  const auto drawn = [&](const std::string& meaning) {
    return std::any_of(drawing.marks.begin(), drawing.marks.end(), [&](const Mark& mark) {
      return std::visit([&](const auto& one) { return one.meaning == meaning; }, mark);
    });
  };
  if (drawn("horizon"))
    entries.push_back({{Disc{{}, 6.0 * unit, {0, 0, 0}, {}, "legend"}}, "horizon"});
  if (drawn("influence"))
    entries.push_back(
        line_entry({ink::influence, 1.1 * unit, 5.0 * unit}, unit, "edge of a mass's influence"));
  if (drawn("portal")) {
    const Color color = portal_color(world.space.portals.portals(), 0);
    entries.push_back(
        {{Lines{{{{-8.0 * unit, -6.0 * unit}, {-8.0 * unit, 6.0 * unit}}}, {color, 2.4 * unit}, ""},
          Lines{{{{-8.0 * unit, 0}, {8.0 * unit, 0}}}, {color, 1.6 * unit}, ""},
          arrow_head({10.0 * unit, 0}, {1, 0}, 9.0 * unit, color, "legend")},
         "portal, its front"});
  }
  return entries;
}

/// What the colours of the paths mean. By fate, the marks at their ends have them, too.
std::vector<LegendEntry> way_entries(const PathStyle& style, double unit) {
  const auto half = [&](double from, const Color& color) {
    return Lines{{{{from * unit, 0}, {(from + 12.0) * unit, 0}}}, {color, 2.2 * unit}, "legend"};
  };
  if (style.color == PathColor::turning)
    return {{{half(-12.0, color_from_linear(turning_color(0.0))),
              half(0.0, color_from_linear(turning_color(1.0)))},
             "straight, and where it turns most"}};
  if (style.color) return {};
  const std::string each = style.steps_a_color == 1
                               ? "steps of a photon"
                               : fmt::format("{} steps each", style.steps_a_color);
  return {{{half(-12.0, ink::green), half(0.0, ink::grey)}, each}};
}

std::vector<LegendEntry> path_entries(const World& world, const std::vector<DrawnPath>& paths,
                                      const PathStyle& style, double unit) {
  std::array<int, fate_count> fates{};
  bool crosses = false, bounces = false;
  for (const DrawnPath& path : paths) {
    ++fates[static_cast<std::size_t>(path.trace.end.fate)];
    crosses = crosses || !path.trace.path_trace.crossings.empty();
    bounces = bounces || !path.trace.bounces.empty();
  }
  std::vector<LegendEntry> entries = way_entries(style, unit);
  entries.push_back({{start_mark({}, unit)}, "start"});
  if (crosses) {
    const Stroke rim{portal_color(world.space.portals.portals(), 0), 1.8 * unit};
    entries.push_back(
        {{Disc{{-5.0 * unit, 0}, 3.2 * unit, {1, 1, 1}, rim, "legend"},
          Label{{2.0 * unit, 4.5 * unit}, "A", 13.0 * unit, rim.color, Anchor::start, "legend"}},
         "crossing: in and out at the same letter"});
  }
  if (bounces) entries.push_back({{bounce_mark({}, unit)}, "bounce"});
  for (std::size_t i = 0; i < fates.size(); ++i) {
    if (fates[i] == 0) continue;
    std::string text(fate_names[i]);
    if (paths.size() > 1) text += fmt::format(": {}", fates[i]);
    entries.push_back(
        {fate_marks(static_cast<Fate>(i), {i == 2 ? 6.0 * unit : 0.0, 0}, {1, 0}, unit), text});
  }
  return entries;
}

}  // namespace

void add_legend(const World& world, const View& view, const std::string& title,
                const std::vector<DrawnPath>& paths, const PathStyle& style, double unit,
                Drawing& drawing) {
  const double top = drawing.height, wide = drawing.width;
  // Lines are cut far outside the picture: what would show in the strip is covered.
  drawing.marks.push_back(
      Area{{{0, top}, {wide, top}, {wide, 2.0 * top + 1e4}, {0, 2.0 * top + 1e4}}, {1, 1, 1}, ""});
  drawing.marks.push_back(
      Lines{{{{0, top + 0.5}, {wide, top + 0.5}}}, {ink::surface, unit}, "legend"});
  Strip strip(unit, drawing);
  if (view.uniform()) strip.add_scale(view.pixels_per_length({}));
  strip.add_line(title, 1.08);
  for (LegendEntry& entry : scene_entries(world, drawing, unit)) strip.add_entry(std::move(entry));
  if (!paths.empty())
    for (LegendEntry& entry : path_entries(world, paths, style, unit))
      strip.add_entry(std::move(entry));
  std::size_t crossing = 0;
  for (std::size_t i = 0; i < paths.size() && paths.size() <= max_told; ++i) {
    const std::string number = paths.size() > 1 ? std::to_string(i + 1) + "  " : "";
    strip.add_line(number + told(world, paths[i], crossing), 1.0);
    crossing += paths[i].trace.path_trace.crossings.size();
  }
  strip.finish();
}

}  // namespace portalens
