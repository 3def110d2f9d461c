#include "gravity/graviton_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "gravity/graviton_bilinear.h"

namespace portalens {

namespace {

/// Nodes across a side so that their spacing is at most `spacing`.
std::uint32_t nodes_across(double side, double spacing) {
  const double cells = std::ceil(side / spacing * (1.0 - 1e-9));
  return static_cast<std::uint32_t>(std::max(1.0, cells)) + 1;
}

std::uint32_t cell_of(double offset, double spacing, std::uint32_t count) {
  // A point that keeps to a grid line, as in a symmetric scene, keeps to one cell.
  const double cell = std::floor(offset / spacing + 1e-9);
  return static_cast<std::uint32_t>(std::clamp(cell, 0.0, static_cast<double>(count - 2)));
}

}  // namespace

GravitonGrid::GravitonGrid(double low_x, double low_y, double high_x, double high_y, int resolution)
    : low_x_(low_x), low_y_(low_y) {
  const double width = high_x - low_x, height = high_y - low_y;
  const double spacing = std::max(width, height) / (std::max(resolution, 2) - 1);
  count_x_ = nodes_across(width, spacing);
  count_y_ = nodes_across(height, spacing);
  spacing_x_ = width / (count_x_ - 1);
  spacing_y_ = height / (count_y_ - 1);
}

double GravitonGrid::kink(std::uint32_t i, std::uint32_t j) const {
  double largest = 0.0;
  const auto bend = [&](const Pull& before, const Pull& after) {
    const Vec3d second = before.acceleration - node(i, j).acceleration * 2.0 + after.acceleration;
    largest = std::max(largest, length(second) / 8.0);
  };
  if (i > 0 && i + 1 < count_x_) bend(node(i - 1, j), node(i + 1, j));
  if (j > 0 && j + 1 < count_y_) bend(node(i, j - 1), node(i, j + 1));
  return largest;
}

void GravitonGrid::find_kinds(double unfelt) {
  std::vector<double> kinks(nodes_.size());
  for (std::uint32_t j = 0; j < count_y_; ++j)
    for (std::uint32_t i = 0; i < count_x_; ++i)
      kinks[static_cast<std::size_t>(j) * count_x_ + i] = kink(i, j);
  for (std::uint32_t j = 0; j + 1 < count_y_; ++j)
    for (std::uint32_t i = 0; i + 1 < count_x_; ++i) {
      Kind kind = Kind::empty;
      for (const std::uint32_t y : {j, j + 1})
        for (const std::uint32_t x : {i, i + 1}) {
          if (node(x, y).acceleration != Vec3d{}) kind = std::max(kind, Kind::even);
          if (kinks[static_cast<std::size_t>(y) * count_x_ + x] > unfelt) kind = Kind::sharp;
        }
      kinds_.push_back(kind);
    }
}

void GravitonGrid::find_sharp() {
  const auto wide = static_cast<std::ptrdiff_t>(count_x_) - 1;
  const auto high = static_cast<std::ptrdiff_t>(count_y_) - 1;
  to_sharp_.assign(kinds_.size(), none_sharp);
  // Once down and once up the rows is enough where aslant counts as straight.
  for (const std::ptrdiff_t back : {-1, 1})
    for (std::ptrdiff_t row = 0; row < high; ++row)
      for (std::ptrdiff_t column = 0; column < wide; ++column) {
        const std::ptrdiff_t j = back < 0 ? row : high - 1 - row;
        const std::ptrdiff_t i = back < 0 ? column : wide - 1 - column;
        std::uint32_t& here = to_sharp_[static_cast<std::size_t>(j * wide + i)];
        if (kinds_[static_cast<std::size_t>(j * wide + i)] == Kind::sharp) here = 0;
        const std::array<std::array<std::ptrdiff_t, 2>, 4> passed = {
            {{back, 0}, {-1, back}, {0, back}, {1, back}}};
        for (const auto [x, y] : passed) {
          if (i + x < 0 || i + x >= wide || j + y < 0 || j + y >= high) continue;
          here = std::min(here, to_sharp_[static_cast<std::size_t>((j + y) * wide + i + x)] + 1);
        }
        here = std::min(here, none_sharp);
      }
}

double GravitonGrid::distance_to_discontinuity(Cell cell, Vec3d at) const {
  const std::uint32_t apart = to_sharp(cell);
  if (apart == 0 || apart == none_sharp) return std::numeric_limits<double>::infinity();
  if (apart > 1) return (apart - 1) * std::min(spacing_x_, spacing_y_);
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t j = std::max(cell.j, 1u) - 1; j <= std::min(cell.j + 1, count_y_ - 2); ++j)
    for (std::uint32_t i = std::max(cell.i, 1u) - 1; i <= std::min(cell.i + 1, count_x_ - 2); ++i) {
      if (kind({i, j}) != Kind::sharp) continue;
      const Vec3d low = place(i, j), high = place(i + 1.0, j + 1.0);
      const double x = std::max({low.x - at.x, at.x - high.x, 0.0});
      const double y = std::max({low.y - at.y, at.y - high.y, 0.0});
      least = std::min(least, std::sqrt(x * x + y * y));
    }
  return least;
}

GravitonGrid::Cell GravitonGrid::cell_at(Vec3d place) const {
  return {cell_of(place.x - low_x_, spacing_x_, count_x_),
          cell_of(place.y - low_y_, spacing_y_, count_y_)};
}

Pull GravitonGrid::interpolate(Cell cell, Vec3d place) const {
  const double u = (place.x - low_x_) / spacing_x_ - cell.i;
  const double v = (place.y - low_y_) / spacing_y_ - cell.j;
  const auto [i, j] = cell;
  const Pull &low = node(i, j), &right = node(i + 1, j), &up = node(i, j + 1),
             &high = node(i + 1, j + 1);
  return {bilinear(low.acceleration, right.acceleration, up.acceleration, high.acceleration, u, v),
          stiffness(cell), nearness(cell), gradient(cell),
          bilinear(low.potential, right.potential, up.potential, high.potential, u, v)};
}

double GravitonGrid::stiffness(Cell cell) const {
  const auto [i, j] = cell;
  return std::max({node(i, j).stiffness, node(i + 1, j).stiffness, node(i, j + 1).stiffness,
                   node(i + 1, j + 1).stiffness});
}

double GravitonGrid::gradient(Cell cell) const {
  const auto [i, j] = cell;
  return std::max({node(i, j).gradient, node(i + 1, j).gradient, node(i, j + 1).gradient,
                   node(i + 1, j + 1).gradient});
}

double GravitonGrid::nearness(Cell cell) const {
  const auto [i, j] = cell;
  return std::max({node(i, j).nearness, node(i + 1, j).nearness, node(i, j + 1).nearness,
                   node(i + 1, j + 1).nearness});
}

}  // namespace portalens
