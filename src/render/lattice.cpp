#include "render/lattice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <variant>

#include "photon/engine.h"

namespace portalens {
namespace {

/// Pixels between two nodes.
constexpr int spacing = 4;
/// Third differences of what guides find, pixels: those of a function that is a polynomial of the
/// third degree but for hundredths of a pixel.
constexpr double most_third_difference = 0.5;

int floor_of(int a, int b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }

/// Lagrange's polynomials over the nodes -1, 0, 1, 2.
std::array<double, 4> weights(double u) {
  const double before = u + 1.0, after = u - 1.0, far = u - 2.0;
  return {-u * after * far * (1.0 / 6.0), before * after * far * 0.5, -before * u * far * 0.5,
          before * u * after * (1.0 / 6.0)};
}

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

std::unique_ptr<const Bicubic> Bicubic::through(const Space& space, const Guides& guides,
                                                const PixelSpan& pixel, double most) {
  if (!interpolable(space, *guides[1][1])) return nullptr;
  for (const auto& row : guides)
    for (const Arrival* guide : row)
      if (!alike(*guide, *guides[1][1])) return nullptr;
  auto result = std::make_unique<Bicubic>();
  result->model_ = *guides[1][1];
  Arrival& model = result->model_;
  model.steps = 0;
  if (model.fate == Fate::absorbed) return result;
  const bool flat = model.fate == Fate::hit;
  double reach = 0.0;
  for (std::size_t n = 0; n < 16; ++n) {
    const Arrival& guide = *guides[n / 4][n % 4];
    const double weight = flat ? model.length / guide.length : 1.0;
    const Vec3d aside = guide.position - model.position, turned = guide.direction - model.direction;
    reach = std::max(reach, length(aside));
    const Vec3d place = aside * weight;
    const double values[9] = {place.x,
                              place.y,
                              place.z,
                              weight - 1.0,
                              turned.x,
                              turned.y,
                              turned.z,
                              guide.length - model.length,
                              guide.turning - model.turning};
    std::copy(values, values + 9, result->values_[n].begin());
  }
  // A miss counts in pixels of where the light came from; to the sky only its direction does.
  const double most_aside =
      flat ? most * (pixel.angle * model.length + pixel.aside) : std::numeric_limits<double>::max();
  const double most_turned = most * (pixel.angle + pixel.aside / space.extent);
  const auto rough = [&](std::size_t first, std::size_t step) {
    const auto value = [&](std::size_t n) { return result->values_[first + n * step].data(); };
    float third[7];
    for (std::size_t k = 0; k < 7; ++k)
      third[k] = value(3)[k] - value(0)[k] + 3.0f * (value(1)[k] - value(2)[k]);
    const double aside = length(part(third)) + reach * std::fabs(third[3]);
    return !(aside <= most_aside) || !(length(part(third + 4)) <= most_turned);
  };
  for (std::size_t i = 0; i < 4; ++i)
    if (rough(4 * i, 1) || rough(i, 4)) return nullptr;
  return result;
}

Arrival Bicubic::at(const Space& space, double u, double v) const {
  Arrival arrival = model_;
  if (arrival.fate == Fate::absorbed) return arrival;
  const auto across = weights(u), down = weights(v);
  Values sum{};
  for (std::size_t n = 0; n < 16; ++n) {
    const auto weight = static_cast<float>(across[n % 4] * down[n / 4]);
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += weight * values_[n][k];
  }
  arrival.position += part(sum.data()) * (1.0 / (1.0 + double{sum[3]}));
  arrival.direction = normalize(arrival.direction + part(sum.data() + 4));
  arrival.length += double{sum[7]};
  arrival.turning += double{sum[8]};
  if (arrival.fate != Fate::hit) return arrival;
  const Shape& shape = space.surfaces.shapes()[arrival.object];
  if (const auto* sphere = std::get_if<Sphere>(&shape))
    arrival.position =
        sphere->center() + normalize(arrival.position - sphere->center()) * sphere->radius();
  return arrival;
}

Lattice::Level Lattice::level(const Window& tile, int stride) {
  const int side = stride * spacing;
  const int column = floor_of(tile.x0, side), row = floor_of(tile.y0, side);
  Level level{stride,
              column,
              row,
              floor_of(tile.x1 - 1, side) - column + 1,
              floor_of(tile.y1 - 1, side) - row + 1,
              {}};
  level.cells.resize(static_cast<std::size_t>(level.columns) *
                     static_cast<std::size_t>(level.rows));
  return level;
}

Lattice::Lattice(const World& world, const BeamGuard& guard, const Window& tile)
    : world_(world),
      guard_(guard),
      view_(world.camera, world.film.width, world.film.height),
      coarse_(level(tile, 2)),
      fine_(level(tile, 1)),
      // The coarse cells and one more about them hold all nodes that are ever asked for.
      first_column_(2 * (coarse_.first_column - 1)),
      first_row_(2 * (coarse_.first_row - 1)),
      columns_(static_cast<std::size_t>(2 * (coarse_.columns + 2) + 1)),
      nodes_(columns_ * static_cast<std::size_t>(2 * (coarse_.rows + 2) + 1)) {}

Lattice::Spot Lattice::spot_in(const Level& level, const FilmPlace& place, std::uint32_t sample) {
  const double cells = 1.0 / (level.stride * spacing);  // a power of 2: nothing is rounded
  const double x = place.x * cells, y = place.y * cells;
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  const int cell = (row - level.first_row) * level.columns + column - level.first_column;
  return {sample, static_cast<std::uint32_t>(cell), x - column, y - row};
}

void Lattice::send_guides(const Level& level, const std::vector<std::size_t>& cells, Tally& tally) {
  std::vector<Photon> photons;
  std::vector<Node*> sent;
  for (const std::size_t cell : cells) {
    const int column = level.first_column + static_cast<int>(cell) % level.columns;
    const int row = level.first_row + static_cast<int>(cell) / level.columns;
    for (int j = -1; j < 3; ++j)
      for (int i = -1; i < 3; ++i) {
        const int x = (column + i) * level.stride, y = (row + j) * level.stride;
        Node& guide = node(x, y);
        if (guide.known) continue;
        guide.known = true;
        const Ray ray = view_.ray(x * spacing, y * spacing);
        Photon& photon = photons.emplace_back();
        photon.position = ray.origin;
        photon.direction = ray.direction;
        sent.push_back(&guide);
      }
  }
  std::vector<Arrival> arrivals(photons.size());
  std::vector<Trail> trails(photons.size());
  advance_with_trails(world_.space, photons, arrivals, trails);
  tally.guides += photons.size();
  for (std::size_t i = 0; i < sent.size(); ++i) {
    sent[i]->arrival = arrivals[i];
    sent[i]->trail = std::move(trails[i]);
  }
}

PixelSpan Lattice::pixel_in(const Level& level, int column, int row) const {
  PixelSpan least{std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
  const int side = level.stride * spacing;
  for (const int x : {column * side, (column + 1) * side})
    for (const int y : {row * side, (row + 1) * side}) {
      const Ray here = view_.ray(x, y);
      for (const Ray& next : {view_.ray(x + 1, y), view_.ray(x, y + 1)}) {
        least.angle = std::min(least.angle, length(next.direction - here.direction));
        least.aside = std::min(least.aside, length(next.origin - here.origin));
      }
    }
  return least;
}

void Lattice::decide(Level& level, std::size_t index) {
  const int column = level.first_column + static_cast<int>(index) % level.columns;
  const int row = level.first_row + static_cast<int>(index) / level.columns;
  const auto at = [&](std::size_t i, std::size_t j) -> const Node& {
    return node((column + static_cast<int>(i) - 1) * level.stride,
                (row + static_cast<int>(j) - 1) * level.stride);
  };
  Bicubic::Guides guides;
  const Trail& first = at(1, 1).trail;
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < 4; ++i) {
      const Node& guide = at(i, j);
      if (!guide.trail.known() || guide.trail.portals() != first.portals()) return;
      guides[j][i] = &guide.arrival;
    }
  auto smooth =
      Bicubic::through(world_.space, guides, pixel_in(level, column, row), most_third_difference);
  if (smooth &&
      guard_.clear({&first, &at(2, 1).trail, &at(1, 2).trail, &at(2, 2).trail}, at(1, 1).arrival))
    level.cells[index].smooth = std::move(smooth);
}

void Lattice::settle(Level& level, const std::vector<Spot>& spots, Tally& tally) {
  std::vector<std::size_t> undecided;
  for (const Spot& spot : spots) {
    Cell& cell = level.cells[spot.cell];
    if (std::exchange(cell.decided, true)) continue;
    undecided.push_back(spot.cell);
  }
  send_guides(level, undecided, tally);
  for (const std::size_t cell : undecided) decide(level, cell);
}

std::vector<std::uint32_t> Lattice::interpolate(const Level& level, const std::vector<Spot>& spots,
                                                std::span<Arrival> arrivals) const {
  std::vector<std::uint32_t> left;
  for (const Spot& spot : spots) {
    if (const auto& smooth = level.cells[spot.cell].smooth)
      arrivals[spot.sample] = smooth->at(world_.space, spot.u, spot.v);
    else
      left.push_back(spot.sample);
  }
  return left;
}

void Lattice::advance(std::span<const Photon> photons, std::span<const FilmPlace> places,
                      std::span<Arrival> arrivals, Tally& tally) {
  std::vector<std::uint32_t> left(photons.size());
  std::iota(left.begin(), left.end(), 0u);
  std::vector<Spot> spots;
  for (Level* level : {&coarse_, &fine_}) {
    spots.clear();
    for (const std::uint32_t i : left) spots.push_back(spot_in(*level, places[i], i));
    settle(*level, spots, tally);
    left = interpolate(*level, spots, arrivals);
  }
  tally.interpolated += photons.size() - left.size();
  std::vector<Photon> own;
  own.reserve(left.size());
  for (const std::uint32_t i : left) {
    const Ray ray = view_.ray(places[i].x, places[i].y);
    Photon& photon = own.emplace_back(photons[i]);
    photon.position = ray.origin;
    photon.direction = ray.direction;
  }
  std::vector<Arrival> found(own.size());
  portalens::advance(world_.space, own, found);
  for (std::size_t i = 0; i < left.size(); ++i) arrivals[left[i]] = found[i];
}

}  // namespace portalens
