#include "render/lattice.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
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

/// Coarse cells that are decided together, about: their guides fill the lanes.
constexpr int cells_at_once = 96;
/// Nodes for which there is room from the beginning.
constexpr std::size_t most_room = 1024;

Vec3d part(const float* values) { return {values[0], values[1], values[2]}; }

/// @pre its length is 1, or nearly
Vec3d unit(Vec3d a) {
  const double square = dot(a, a);
  // One step of Newton's method leaves 4e-11 of that, and is done in half the time.
  return std::fabs(square - 1.0) < 1e-5 ? a * (1.5 - 0.5 * square) : a * inverse_sqrt(square);
}

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
  const auto in_float = [](double x) { return static_cast<float>(x); };
  std::array<Values, 16> values;
  // Whether it bends too much along any row or column of the lattice.
  const auto rough = [&](const auto& bent_too_much) {
    const auto is_rough = [&](std::size_t first, std::size_t step) {
      const auto value = [&](std::size_t n) { return values[first + n * step].data(); };
      float third[8];
      for (std::size_t k = 0; k < 8; ++k)
        third[k] = value(3)[k] - value(0)[k] + 3.0f * (value(1)[k] - value(2)[k]);
      return bent_too_much(third);
    };
    for (std::size_t i = 0; i < 4; ++i)
      if (is_rough(4 * i, 1) || is_rough(i, 4)) return true;
    return false;
  };
  for (std::size_t n = 0; n < 16; ++n) {
    const Vec3d turned = guides[n / 4][n % 4]->direction - model_.direction;
    values[n] = {0, 0, 0, 0, in_float(turned.x), in_float(turned.y), in_float(turned.z)};
  }
  const double most_turned = most * (pixel.angle + pixel.aside / space.extent);
  if (rough([&](const float* third) { return !(length(part(third + 4)) <= most_turned); }))
    return false;
  double reach = 0.0;
  for (std::size_t n = 0; n < 16; ++n) {
    const Arrival& guide = *guides[n / 4][n % 4];
    const double weight = flat ? model_.length / guide.length : 1.0;
    const Vec3d aside = guide.position - model_.position;
    reach = std::max(reach, dot(aside, aside));
    const Vec3d place = aside * weight;
    values[n][0] = in_float(place.x);
    values[n][1] = in_float(place.y);
    values[n][2] = in_float(place.z);
    values[n][3] = in_float(weight - 1.0);
    values[n][7] = in_float(guide.length - model_.length);
    values[n][8] = in_float(guide.turning - model_.turning);
  }
  if (flat) {
    reach = std::sqrt(reach);
    // A miss counts in pixels of where the light came from; to the sky only its direction does.
    const double most_aside = most * (pixel.angle * model_.length + pixel.aside);
    if (rough([&](const float* third) {
          return !(length(part(third)) + reach * std::fabs(third[3]) <= most_aside);
        }))
      return false;
  }
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
  arrival.direction = unit(arrival.direction + part(sum.data() + 4));
  arrival.length += double{sum[7]};
  arrival.turning += double{sum[8]};
  if (const Sphere* sphere = cell_.sphere_)
    arrival.position =
        sphere->center() + normalize(arrival.position - sphere->center()) * sphere->radius();
}

void Lattice::Level::clear(int column, int row, int column_count, int row_count) {
  first_column = column;
  first_row = row;
  columns = column_count;
  rows = row_count;
  smooth.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), none);
}

Lattice::Lattice(const World& world, const BeamGuard& guard, const Window& tile)
    : world_(world), guard_(guard), view_(world.camera, world.film.width, world.film.height) {
  lay_over(tile);
}

void Lattice::lay_over(const Window& tile) {
  constexpr int side = 2 * spacing;
  tile_ = tile;
  const int column = tile.x0 / side, row = tile.y0 / side;
  const int columns = (tile.x1 - 1) / side - column + 1, rows = (tile.y1 - 1) / side - row + 1;
  coarse_.clear(column, row, columns, rows);
  fine_.clear(2 * column, 2 * row, 2 * columns, 2 * rows);
  settled_ = 0.0;
  // The coarse cells and one more about them hold all nodes that are ever asked for.
  first_column_ = 2 * (column - 1);
  first_row_ = 2 * (row - 1);
  columns_ = static_cast<std::size_t>(2 * (columns + 2) + 1);
  nodes_.assign(columns_ * static_cast<std::size_t>(2 * (rows + 2) + 1), none);
  guides_.clear();
  pixels_.clear();
  arrivals_.clear();
  smooth_.clear();
  // So that nothing moves while it grows; what is not used costs nothing.
  const std::size_t room = std::min(nodes_.size(), most_room);
  guides_.reserve(room);
  pixels_.reserve(room);
  arrivals_.reserve(room);
  trails_.reserve(room);
  smooth_.reserve(room);
}

Lattice::Spot Lattice::spot_in(const Level& level, const FilmPlace& place) {
  const double cells = 1.0 / (level.stride * spacing);  // a power of 2: nothing is rounded
  const double x = place.x * cells, y = place.y * cells;
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  const int cell = (row - level.first_row) * level.columns + column - level.first_column;
  return {static_cast<std::size_t>(cell), x - column, y - row};
}

void Lattice::send_guides(const Level& level, Tally& tally) {
  const std::size_t first = guides_.size();
  for (const auto& [column, row] : undecided_)
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

PixelSpan Lattice::pixel_in(const Level& level, const Cell& cell) {
  PixelSpan least = pixel_at(cell.column * level.stride, cell.row * level.stride);
  for (const auto& [i, j] : {std::pair{1, 0}, std::pair{0, 1}, std::pair{1, 1}}) {
    const PixelSpan& pixel =
        pixel_at((cell.column + i) * level.stride, (cell.row + j) * level.stride);
    least.angle = std::min(least.angle, pixel.angle);
    least.aside = std::min(least.aside, pixel.aside);
  }
  return least;
}

void Lattice::decide(Level& level, const Cell& cell) {
  std::array<std::array<std::uint32_t, 4>, 4> at;
  Bicubic::Guides guides;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      at[j][i] = node((cell.column + i - 1) * level.stride, (cell.row + j - 1) * level.stride);
      guides[j][i] = &arrivals_[at[j][i]];
    }
  if (!Bicubic::agree(world_.space, guides)) return;
  const Trail& first = trails_[at[1][1]];
  for (const auto& row : at)
    for (const std::uint32_t guide : row)
      if (!trails_[guide].known() || trails_[guide].portals() != first.portals()) return;
  const bool smooth = smooth_.emplace_back().through(world_.space, guides, pixel_in(level, cell),
                                                     most_third_difference(world_.space));
  if (smooth && guard_.clear({&first, &trails_[at[1][2]], &trails_[at[2][1]], &trails_[at[2][2]]},
                             *guides[1][1])) {
    const int index =
        (cell.row - level.first_row) * level.columns + cell.column - level.first_column;
    level.smooth[static_cast<std::size_t>(index)] = static_cast<std::uint32_t>(smooth_.size() - 1);
  } else {
    smooth_.pop_back();
  }
}

void Lattice::settle(Level& level, Tally& tally) {
  if (undecided_.empty()) return;
  send_guides(level, tally);
  for (const Cell& cell : undecided_) decide(level, cell);
}

void Lattice::settle_from(int row, Tally& tally) {
  const int end = std::min(coarse_.first_row + coarse_.rows,
                           row + std::max(1, cells_at_once / coarse_.columns));
  undecided_.clear();
  for (int j = row; j < end; ++j)
    for (int i = 0; i < coarse_.columns; ++i) undecided_.push_back({coarse_.first_column + i, j});
  settle(coarse_, tally);
  undecided_.clear();
  for (int j = 2 * row; j < 2 * end; ++j)
    for (int i = 0; i < fine_.columns; ++i) {
      const int column = fine_.first_column + i;
      const Spot larger = spot_in(coarse_, {1.0 * column * spacing, 1.0 * j * spacing});
      const bool outside = column * spacing >= tile_.x1 || (column + 1) * spacing <= tile_.x0 ||
                           j * spacing >= tile_.y1 || (j + 1) * spacing <= tile_.y0;
      if (!outside && coarse_.smooth[larger.cell] == none) undecided_.push_back({column, j});
    }
  settle(fine_, tally);
  settled_ = end * coarse_.stride * spacing;
}

std::uint32_t Lattice::smooth_at(const FilmPlace& place, Spot& spot) const {
  spot = spot_in(coarse_, place);
  if (const std::uint32_t smooth = coarse_.smooth[spot.cell]; smooth != none) return smooth;
  spot = spot_in(fine_, place);
  return fine_.smooth[spot.cell];
}

void Lattice::advance(std::span<const FilmPlace> places, std::span<Arrival> arrivals,
                      Tally& tally) {
  left_.clear();
  // Samples come along rows of pixels: with one in each, a cell's row is worked out once.
  std::optional<Bicubic::Row> row;
  std::uint32_t last = none;
  double above = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].y >= settled_) {
      settle_from(static_cast<int>(places[i].y) / (2 * spacing), tally);
      last = none;
    }
    Spot spot;
    const std::uint32_t smooth = smooth_at(places[i], spot);
    if (smooth == none) {
      left_.push_back(static_cast<std::uint32_t>(i));
      continue;
    }
    if (smooth != last || spot.v != above) {
      row.emplace(smooth_[smooth], spot.v);
      last = smooth;
      above = spot.v;
    }
    row->tell(spot.u, arrivals[i]);
  }
  tally.interpolated += places.size() - left_.size();
  send_left(places, arrivals);
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

}  // namespace portalens
