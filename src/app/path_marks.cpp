#include "app/path_marks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "app/portal_color.h"
#include "app/scene_marks.h"

namespace portalens {
namespace {

constexpr std::size_t max_letters = 120;  ///< more crossings than this are only dots
constexpr std::size_t max_numbers = 12;   ///< more paths than this bear no number

constexpr Color white{1, 1, 1};

/// Steps of the whole path in turn in one list or the other. Points that repeat are no step.
void add_steps(const PathTrace& path_trace, const PathStyle& style, Sheet& sheet) {
  std::vector<std::vector<Vec3d>> green, grey;
  std::size_t step = 0;
  for (const std::vector<Vec3d>& stretch : path_trace.stretches)
    for (std::size_t i = 1; i < stretch.size(); ++i) {
      if (stretch[i] == stretch[i - 1] || !is_finite(stretch[i])) continue;
      const bool odd = step++ / static_cast<std::size_t>(style.steps_a_color) % 2 == 1;
      (odd ? grey : green).push_back({stretch[i - 1], stretch[i]});
      if (const auto at = sheet.view().project((stretch[i] + stretch[i - 1]) * 0.5))
        sheet.keep_free(*at);
    }
  sheet.add_lines(green, {ink::green, 2.2}, "path green");
  sheet.add_lines(grey, {ink::grey, 2.2}, "path grey");
}

/// All paths as `PathExport` colours them: neighbouring pieces of one colour are one line.
void add_colored(const World& world, const std::vector<DrawnPath>& paths, PathColor color,
                 Sheet& sheet) {
  PathExport ways(world, color);
  for (const DrawnPath& path : paths) ways.add(path.trace);
  const PathPicture picture = std::move(ways).release();
  for (const PathLine& way : picture.lines) {
    for (std::size_t begin = 0, end = 1; end < way.points.size(); begin = end++) {
      while (end + 1 < way.points.size() && way.colors[end + 1] == way.colors[end]) ++end;
      sheet.add_lines({{way.points.begin() + static_cast<std::ptrdiff_t>(begin),
                        way.points.begin() + static_cast<std::ptrdiff_t>(end) + 1}},
                      {color_from_linear(way.colors[end]), 2.2}, "path");
    }
    for (std::size_t i = 1; i < way.points.size(); ++i)
      if (const auto at = sheet.view().project((way.points[i] + way.points[i - 1]) * 0.5))
        sheet.keep_free(*at);
  }
}

void add_crossings(const World& world, const PathTrace& path_trace, std::size_t& number,
                   Sheet& sheet) {
  for (std::size_t i = 0; i < path_trace.crossings.size(); ++i, ++number) {
    const std::uint32_t entered = path_trace.crossings[i];
    const auto mark = [&](Vec3d place, std::uint32_t portal) {
      const auto at = sheet.view().project(place);
      if (!at) return;
      const double unit = sheet.unit();
      const Color color = portal_color(world.space.portals.portals(), portal);
      sheet.add(Disc{*at, 3.2 * unit, white, {color, 1.8 * unit}, "crossing"});
      if (number < max_letters)
        sheet.add_label(*at, 7.0, crossing_letter(number), color, "crossing letter");
    };
    mark(path_trace.stretches[i].back(), entered);
    mark(path_trace.stretches[i + 1].front(), world.space.portals.portals()[entered].pair);
  }
}

/// What an escaped photon flies on, and the mark at its end; elsewhere the mark at the end.
void add_end(const Arrival& end, const PathStyle& style, const std::string& number, Sheet& sheet) {
  if (!is_finite(end.position)) return;
  Vec3d last = end.position;
  if (end.fate == Fate::escaped) {
    const Vec3d farther = last + end.direction * style.beyond;
    sheet.add_lines({{last, farther}}, {style.color ? fate_ink(end.fate) : ink::green, 1.3, 4.0},
                    "beyond");
    if (sheet.view().project(farther)) last = farther;
  }
  const auto at = sheet.view().project(last);
  if (!at) return;
  const auto before = sheet.view().project(last - end.direction * (0.05 * style.beyond));
  for (Mark& mark : fate_marks(end.fate, *at, before ? *at - *before : Point{}, sheet.unit()))
    sheet.add(std::move(mark));
  if (!number.empty()) sheet.add_label(*at, 9.0, number, ink::black, "number");
}

void add_bounces(const Trace& trace, Sheet& sheet) {
  for (const Arrival& bounce : trace.bounces)
    if (const auto at = sheet.view().project(bounce.position))
      sheet.add(bounce_mark(*at, sheet.unit()));
}

/// The names of the surfaces that are met, each once.
void add_names_of_met(const World& world, const std::vector<DrawnPath>& paths, Sheet& sheet) {
  std::set<std::string> named;
  const auto name = [&](const Arrival& arrival) {
    if (arrival.met != Met::surface) return;
    const std::string met = name_of_met(world, arrival);
    const auto at = sheet.view().project(arrival.position);
    if (at && named.size() < max_numbers && named.insert(met).second)
      sheet.add_label(*at, 11.0, met, {0.45, 0.45, 0.48}, "surface name", 0.92);
  };
  for (const DrawnPath& path : paths) {
    for (const Arrival& bounce : path.trace.bounces) name(bounce);
    name(path.trace.end);
  }
}

}  // namespace

std::string crossing_letter(std::size_t number) {
  std::string letters;
  for (std::size_t rest = number + 1; rest > 0; rest = (rest - 1) / 26)
    letters.insert(letters.begin(), static_cast<char>('A' + (rest - 1) % 26));
  return letters;
}

std::string told(const World& world, const DrawnPath& path, std::size_t crossing) {
  const Trace& trace = path.trace;
  const auto portals = world.space.portals.portals();
  std::string text = path.name + ": ";
  std::size_t next = 0;
  const auto cross = [&](const Arrival& leg) {
    for (std::uint32_t i = 0; i < leg.crossings && next < trace.path_trace.crossings.size(); ++i) {
      const Portal& portal = portals[trace.path_trace.crossings[next++]];
      text += fmt::format("{} into {}, out of {}; ", crossing_letter(crossing++), portal.name,
                          portals[portal.pair].name);
    }
  };
  for (const Arrival& bounce : trace.bounces) {
    cross(bounce);
    text += fmt::format("bounces off {}; ", name_of_met(world, bounce));
  }
  cross(trace.end);
  const std::string met = name_of_met(world, trace.end);
  switch (trace.end.fate) {
    case Fate::hit:
      text += "hits " + met;
      break;
    case Fate::absorbed:
      text += "absorbed by " + met;
      break;
    case Fate::lost:
      text += "lost";
      if (trace.end.out_of_crossings)
        text +=
            fmt::format(" at its next crossing (max_crossings = {})", world.space.max_crossings);
      break;
    default:
      text += fate_names[static_cast<std::size_t>(trace.end.fate)];
  }
  return text + fmt::format(" ({} steps, turned {:.0f} degrees)", trace.end.steps,
                            trace.end.turning * 180.0 / std::numbers::pi);
}

void add_paths(const World& world, const std::vector<DrawnPath>& paths, const PathStyle& style,
               Sheet& sheet) {
  if (style.color)
    add_colored(world, paths, *style.color, sheet);
  else
    for (const DrawnPath& path : paths) add_steps(path.trace.path_trace, style, sheet);
  const bool numbered = paths.size() > 1 && paths.size() <= max_numbers;
  std::size_t crossing = 0;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const Trace& trace = paths[i].trace;
    add_crossings(world, trace.path_trace, crossing, sheet);
    add_bounces(trace, sheet);
    const auto start = sheet.view().project(trace.path_trace.stretches.front().front());
    if (start) sheet.add(start_mark(*start, sheet.unit()));
    add_end(trace.end, style, numbered ? std::to_string(i + 1) : "", sheet);
  }
  add_names_of_met(world, paths, sheet);
}

std::vector<Mark> fate_marks(Fate fate, Point at, Point way, double unit) {
  const auto square = [&](double r) {
    return PointChain{{at.x - r, at.y - r},
                      {at.x + r, at.y - r},
                      {at.x + r, at.y + r},
                      {at.x - r, at.y + r},
                      {at.x - r, at.y - r}};
  };
  const double r = 4.0 * unit;
  switch (fate) {
    case Fate::hit:
      return {Disc{at, r, fate_ink(fate), {white, unit}, "fate hit"}};
    case Fate::absorbed:
      return {Disc{at, r, {0, 0, 0}, {white, 1.6 * unit}, "fate absorbed"}};
    case Fate::escaped:
      return {arrow_head(at, way, 12.0 * unit, fate_ink(fate), "fate escaped")};
    case Fate::trapped:
      return {Area{square(r), white, "fate trapped"},
              Lines{{square(r)}, {fate_ink(fate), 2.0 * unit}, "fate trapped"}};
    case Fate::lost:
      break;
  }
  return {Lines{
      {{{at.x - r, at.y - r}, {at.x + r, at.y + r}}, {{at.x - r, at.y + r}, {at.x + r, at.y - r}}},
      {fate_ink(fate), 2.6 * unit},
      "fate lost"}};
}

Mark start_mark(Point at, double unit) {
  return Disc{at, 3.2 * unit, white, {ink::black, 1.4 * unit}, "start"};
}

Mark bounce_mark(Point at, double unit) {
  const double r = 5.0 * unit;
  return Area{{{at.x, at.y - r}, {at.x + r, at.y}, {at.x, at.y + r}, {at.x - r, at.y}},
              fate_ink(Fate::hit),
              "bounce"};
}

}  // namespace portalens
