/// \file
/// Photons' paths, drawn: a chain of steps in two colours in turn, with marks where something
/// happens.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/path_export.h"
#include "app/sheet.h"
#include "app/trace_ray.h"
#include "world/world.h"

namespace portalens {

/// Colours of the paths of photons by their end, in the order of `Fate`: red, dark grey, blue,
/// orange, magenta.
inline constexpr std::array<Color, fate_count> fate_inks = {
    Color{0.80, 0.10, 0.10}, Color{0.25, 0.25, 0.28}, Color{0.10, 0.45, 0.80},
    Color{0.85, 0.50, 0.00}, Color{0.90, 0.00, 0.85}};
[[nodiscard]] constexpr const Color& fate_ink(Fate fate) {
  return fate_inks[static_cast<std::size_t>(fate)];
}

struct DrawnPath {
  std::string name;  ///< what the user asked for: "pixel 3 4"
  Trace trace;
};

struct PathStyle {
  int steps_a_color = 1;           ///< >= 1; in turn green and grey, if `color` is not given
  std::optional<PathColor> color;  ///< what else a path's colour tells
  double beyond = 1.0;             ///< length that is drawn of what an escaped photon flies on
};

/// What a path tells of itself, in one line; its crossings have the letters that the drawing has.
/// @param crossing  number of its first crossing, among all the paths'
[[nodiscard]] std::string told(const World& world, const DrawnPath& path, std::size_t crossing);

/// The letter of a crossing: A to Z, AA, AB, ...
[[nodiscard]] std::string crossing_letter(std::size_t number);

/// Steps, crossings, bounces, starts and ends of all the paths.
void add_paths(const World& world, const std::vector<DrawnPath>& paths, const PathStyle& style,
               Sheet& sheet);

/// The mark at the end of a photon with that fate, flying `way` on the drawing.
[[nodiscard]] std::vector<Mark> fate_marks(Fate fate, Point at, Point way, double unit);
[[nodiscard]] Mark start_mark(Point at, double unit);
[[nodiscard]] Mark bounce_mark(Point at, double unit);

}  // namespace portalens
