#include "render/lattice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <variant>

#include "photon/engine.h"

namespace portalens {
namespace {

/// Pixels between two nodes.
constexpr int spacing = 4;
/// Third differences of what guides find, pixels: those of a function that is a polynomial of the
/// third degree but for hundredths of a pixel. What masses do by themselves is smooth between the
/// borders that the guard looks for; gravity through portals bends sharply at more than those.
double most_third_difference(const Space& space) {
  return std::holds_alternative<NoCoupling>(space.coupling) ? 3.0 : 0.5;
}

int floor_of(int a, int b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }

Vec3d part(const float* values) { return {values[0], values[1], values[2]}; }

bool alike(const Arrival& a, const Arrival& b) {
  return a.fate == b.fate && a.met == b.met && a.object == b.object && a.face == b.face &&
         a.crossings == b.crossings;
}

bool interpolable(const Space& space, const Arrival& arrival) {
  if (arrival.fate == Fate::escaped || arrival.fate == Fate::absorbed) return true;
  if (arrival.fate != Fate::hit || arrival.met != Met::surface) return false;
  const Shape& shape = space.surfaces.shapes()[arrival.object];
  return std::holds_alternative<Quad>(shape) || std::holds_alternative<Sphere>(shape);
}

}  // namespace

bool Bicubic::agree(const Space& space, const Guides& guides) {
  if (!interpolable(space, *guides[1][1])) return false;
  for (const auto& row : guides)
    for (const Arrival* guide : row)
      if (!alike(*guide, *guides[1][1])) return false;
  return true;
}

bool Bicubic::through(const Space& space, const Guides& guides, const PixelSpan& pixel,
                      double most) {
  model_ = *guides[1][1];
  model_.steps = 0;
  if (model_.fate == Fate::absorbed) return true;
  const bool flat = model_.fate == Fate::hit;
  sphere_ = flat ? std::get_if<Sphere>(&space.surfaces.shapes()[model_.object]) : nullptr;
  std::array<Values, 16> values;
  double reach = 0.0;
  for (std::size_t n = 0; n < 16; ++n) {
    const Arrival& guide = *guides[n / 4][n % 4];
    const double weight = flat ? model_.length / guide.length : 1.0;
    const Vec3d aside = guide.position - model_.position,
                turned = guide.direction - model_.direction;
    reach = std::max(reach, dot(aside, aside));
    const Vec3d place = aside * weight;
    const auto in_float = [](double x) { return static_cast<float>(x); };
    values[n] = {in_float(place.x),
                 in_float(place.y),
                 in_float(place.z),
                 in_float(weight - 1.0),
                 in_float(turned.x),
                 in_float(turned.y),
                 in_float(turned.z),
                 in_float(guide.length - model_.length),
                 in_float(guide.turning - model_.turning)};
  }
  reach = std::sqrt(reach);
  // A miss counts in pixels of where the light came from; to the sky only its direction does.
  const double most_aside = flat ? most * (pixel.angle * model_.length + pixel.aside)
                                 : std::numeric_limits<double>::max();
  const double most_turned = most * (pixel.angle + pixel.aside / space.extent);
  const auto rough = [&](std::size_t first, std::size_t step) {
    const auto value = [&](std::size_t n) { return values[first + n * step].data(); };
    float third[7];
    for (std::size_t k = 0; k < 7; ++k)
      third[k] = value(3)[k] - value(0)[k] + 3.0f * (value(1)[k] - value(2)[k]);
    const double aside = length(part(third)) + reach * std::fabs(third[3]);
    return !(aside <= most_aside) || !(length(part(third + 4)) <= most_turned);
  };
  for (std::size_t i = 0; i < 4; ++i)
    if (rough(4 * i, 1) || rough(i, 4)) return false;
  std::array<Cubic, 4> rows;
  for (std::size_t j = 0; j < 4; ++j) {
    const Values* row = &values[4 * j];
    rows[j] = cubic_through(row[0], row[1], row[2], row[3]);
  }
  for (std::size_t k = 0; k < 4; ++k)
    cubics_[k] = cubic_through(rows[0][k], rows[1][k], rows[2][k], rows[3][k]);
  return true;
}

/// From Lagrange's polynomials over the nodes -1, 0, 1, 2.
Bicubic::Cubic Bicubic::cubic_through(const Values& before, const Values& first,
                                      const Values& second, const Values& after) {
  Cubic cubic;
  for (std::size_t k = 0; k < first.size(); ++k) {
    const float bend = 0.5f * (before[k] + second[k]) - first[k];
    const float twist = (after[k] - before[k]) * (1.0f / 6.0f) + 0.5f * (first[k] - second[k]);
    cubic[0][k] = first[k];
    cubic[1][k] = second[k] - first[k] - bend - twist;
    cubic[2][k] = bend;
    cubic[3][k] = twist;
  }
  return cubic;
}

Bicubic::Values Bicubic::value(const Cubic& cubic, float at) {
  Values sum;
  for (std::size_t k = 0; k < sum.size(); ++k)
    sum[k] = ((cubic[3][k] * at + cubic[2][k]) * at + cubic[1][k]) * at + cubic[0][k];
  return sum;
}

Bicubic::Row::Row(const Bicubic& cell, double v) : cell_(cell) {
  for (std::size_t k = 0; k < 4; ++k) cubic_[k] = value(cell.cubics_[k], static_cast<float>(v));
}

void Bicubic::Row::tell(double u, Arrival& arrival) const {
  arrival = cell_.model_;
  if (arrival.fate == Fate::absorbed) return;
  const Values sum = value(cubic_, static_cast<float>(u));
  arrival.position += part(sum.data()) * (1.0 / (1.0 + double{sum[3]}));
  arrival.direction = normalize(arrival.direction + part(sum.data() + 4));
  arrival.length += double{sum[7]};
  arrival.turning += double{sum[8]};
  if (const Sphere* sphere = cell_.sphere_)
    arrival.position =
        sphere->center() + normalize(arrival.position - sphere->center()) * sphere->radius();
}

void Lattice::Level::lay_over(const Window& tile) {
  const int side = stride * spacing;
  first_column = floor_of(tile.x0, side);
  first_row = floor_of(tile.y0, side);
  columns = floor_of(tile.x1 - 1, side) - first_column + 1;
  rows = floor_of(tile.y1 - 1, side) - first_row + 1;
  cells.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), Cell{});
}

Lattice::Lattice(const World& world, const BeamGuard& guard, const Window& tile)
    : world_(world), guard_(guard), view_(world.camera, world.film.width, world.film.height) {
  lay_over(tile);
}

void Lattice::lay_over(const Window& tile) {
  coarse_.lay_over(tile);
  fine_.lay_over(tile);
  // The coarse cells and one more about them hold all nodes that are ever asked for.
  first_column_ = 2 * (coarse_.first_column - 1);
  first_row_ = 2 * (coarse_.first_row - 1);
  columns_ = static_cast<std::size_t>(2 * (coarse_.columns + 2) + 1);
  nodes_.assign(columns_ * static_cast<std::size_t>(2 * (coarse_.rows + 2) + 1), none);
  guides_.clear();
  pixels_.clear();
  smooth_.clear();
}

Lattice::Spot Lattice::spot_in(const Level& level, const FilmPlace& place) {
  const double cells = 1.0 / (level.stride * spacing);  // a power of 2: nothing is rounded
  const double x = place.x * cells, y = place.y * cells;
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  const int cell = (row - level.first_row) * level.columns + column - level.first_column;
  return {static_cast<std::uint32_t>(cell), x - column, y - row};
}

void Lattice::send_guides(const Level& level, Tally& tally) {
  const std::size_t first = guides_.size();
  for (const std::uint32_t cell : undecided_) {
    const int column = level.first_column + static_cast<int>(cell) % level.columns;
    const int row = level.first_row + static_cast<int>(cell) / level.columns;
    for (int j = -1; j < 3; ++j)
      for (int i = -1; i < 3; ++i) {
        const int x = (column + i) * level.stride, y = (row + j) * level.stride;
        std::uint32_t& guide = node(x, y);
        if (guide != none) continue;
        guide = static_cast<std::uint32_t>(guides_.size());
        const Ray ray = view_.ray(x * spacing, y * spacing);
        Photon& photon = guides_.emplace_back();
        photon.position = ray.origin;
        photon.direction = ray.direction;
      }
  }
  const std::size_t count = guides_.size() - first;
  pixels_.resize(guides_.size(), {-1.0, -1.0});
  arrivals_.resize(guides_.size());
  if (trails_.size() < guides_.size()) trails_.resize(guides_.size());
  advance_with_trails(world_.space, std::span(guides_).subspan(first),
                      std::span(arrivals_).subspan(first),
                      std::span(trails_).subspan(first, count));
  tally.guides += count;
}

const PixelSpan& Lattice::pixel_at(int column, int row) {
  const std::uint32_t guide = node(column, row);
  PixelSpan& pixel = pixels_[guide];
  if (pixel.angle >= 0.0) return pixel;
  const int x = column * spacing, y = row * spacing;
  const Photon& here = guides_[guide];
  const Ray right = view_.ray(x + 1, y), below = view_.ray(x, y + 1);
  pixel.angle =
      std::min(length(right.direction - here.direction), length(below.direction - here.direction));
  pixel.aside =
      std::min(length(right.origin - here.position), length(below.origin - here.position));
  return pixel;
}

PixelSpan Lattice::pixel_in(const Level& level, int column, int row) {
  PixelSpan least = pixel_at(column * level.stride, row * level.stride);
  for (const auto& [i, j] : {std::pair{1, 0}, std::pair{0, 1}, std::pair{1, 1}}) {
    const PixelSpan& pixel = pixel_at((column + i) * level.stride, (row + j) * level.stride);
    least.angle = std::min(least.angle, pixel.angle);
    least.aside = std::min(least.aside, pixel.aside);
  }
  return least;
}

void Lattice::decide(Level& level, std::uint32_t index) {
  const int column = level.first_column + static_cast<int>(index) % level.columns;
  const int row = level.first_row + static_cast<int>(index) / level.columns;
  const auto at = [&](std::size_t i, std::size_t j) {
    return node((column + static_cast<int>(i) - 1) * level.stride,
                (row + static_cast<int>(j) - 1) * level.stride);
  };
  Bicubic::Guides guides;
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < 4; ++i) guides[j][i] = &arrivals_[at(i, j)];
  if (!Bicubic::agree(world_.space, guides)) return;
  const Trail& first = trails_[at(1, 1)];
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < 4; ++i) {
      const Trail& trail = trails_[at(i, j)];
      if (!trail.known() || trail.portals() != first.portals()) return;
    }
  const bool smooth = smooth_.emplace_back().through(
      world_.space, guides, pixel_in(level, column, row), most_third_difference(world_.space));
  if (smooth && guard_.clear({&first, &trails_[at(2, 1)], &trails_[at(1, 2)], &trails_[at(2, 2)]},
                             *guides[1][1]))
    level.cells[index].smooth = static_cast<std::uint32_t>(smooth_.size() - 1);
  else
    smooth_.pop_back();
}

void Lattice::settle(Level& level, std::span<const FilmPlace> places, Tally& tally) {
  undecided_.clear();
  for (const std::uint32_t sample : left_) {
    const std::uint32_t index = spot_in(level, places[sample]).cell;
    Cell& cell = level.cells[index];
    if (cell.decided) continue;
    cell.decided = true;
    undecided_.push_back(index);
  }
  if (undecided_.empty()) return;
  send_guides(level, tally);
  for (const std::uint32_t cell : undecided_) decide(level, cell);
}

void Lattice::interpolate(const Level& level, std::span<const FilmPlace> places,
                          std::span<Arrival> arrivals) {
  std::size_t kept = 0;
  // Samples come along rows of pixels: with one in each, a cell's row is worked out once.
  std::optional<Bicubic::Row> row;
  std::uint32_t at = none;
  double above = 0.0;
  for (const std::uint32_t sample : left_) {
    const Spot spot = spot_in(level, places[sample]);
    const std::uint32_t smooth = level.cells[spot.cell].smooth;
    if (smooth == none) {
      left_[kept++] = sample;
      continue;
    }
    if (smooth != at || spot.v != above) {
      row.emplace(smooth_[smooth], spot.v);
      at = smooth;
      above = spot.v;
    }
    row->tell(spot.u, arrivals[sample]);
  }
  left_.resize(kept);
}

void Lattice::send_left(std::span<const FilmPlace> places, std::span<Arrival> arrivals) {
  own_.resize(left_.size());
  found_.resize(left_.size());
  for (std::size_t i = 0; i < left_.size(); ++i) {
    const FilmPlace& place = places[left_[i]];
    const Ray ray = view_.ray(place.x, place.y);
    own_[i].position = ray.origin;
    own_[i].direction = ray.direction;
  }
  portalens::advance(world_.space, own_, found_);
  for (std::size_t i = 0; i < left_.size(); ++i) arrivals[left_[i]] = found_[i];
}

void Lattice::advance(std::span<const FilmPlace> places, std::span<Arrival> arrivals,
                      Tally& tally) {
  left_.resize(places.size());
  std::iota(left_.begin(), left_.end(), 0u);
  for (Level* level : {&coarse_, &fine_}) {
    settle(*level, places, tally);
    interpolate(*level, places, arrivals);
  }
  tally.interpolated += places.size() - left_.size();
  send_left(places, arrivals);
}

}  // namespace portalens
