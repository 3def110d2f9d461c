/// \file
/// What random scenes are put together from.
#pragma once

#include <vector>

#include "differential/draft.h"
#include "differential/lot.h"

namespace portalens::differential {

/// Of constants c = 45 and G = 1 and lengths of some units, as drafts are before they are placed.
inline constexpr double light_speed2 = 45.0 * 45.0;

/// Radius of influence of a mass.
[[nodiscard]] double influence_of(const Draft& draft, double mass);

/// A simple polygon about the origin of its frame, counter-clockwise, no farther than `size` from
/// it.
[[nodiscard]] std::vector<Vec3d> random_polygon(Lot& lot, double size);
/// Four corners, `width` by `height`, about the origin.
[[nodiscard]] std::vector<Vec3d> rectangle(double width, double height);

[[nodiscard]] bool is_rectangle(const std::vector<Vec3d>& polygon);

/// Adds a pair: the polygon in the one frame, and what fits it in the other.
void add_pair(Draft& draft, const std::vector<Vec3d>& polygon, const Frame& a, const Frame& b);

/// Turns the scene about its origin, makes it `scale` times as large, and moves it: every picture
/// stays what it was.
void place(Draft& draft, const Frame& turned, double scale, Vec3d offset);
/// The same by chance: sizes from 1e-4 to 1e6, some far from the origin.
void place_somewhere(Draft& draft, Lot& lot);

}  // namespace portalens::differential
