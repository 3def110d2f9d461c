#include "render/sampling_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "lanes/engine.h"

namespace portalens {
namespace {

/// Pixels between two nodes.
constexpr int spacing = 2;
/// Nodes from corner to corner of the largest cells, and pixels.
constexpr int coarse = 4, coarse_spacing = coarse * spacing;
/// Where the first node lies: nodes are centres of pixels, and no sample lies before the first.
constexpr double first_node = 0.5 - coarse_spacing;

/// Third differences of what probe rays find, pixels: those of a function that is a polynomial of
/// the third degree but for hundredths of a pixel. What masses do by themselves is smooth between
/// the borders that the guard looks for: there the small cells may differ by more, since what they
/// spare is whole photons, and of the smallest every fourth pixel has a probe ray of its own.
/// Gravity through portals bends sharply at more than those borders.
double max_third_difference(const Space& space, int stride) {
  if (!std::holds_alternative<NoCoupling>(space.coupling)) return 0.39;
  return stride == coarse ? 3.4 : stride == 1 ? 8.7 : 4.35;
}

/// The share of that which is allowed where the probe rays lie aside: outside of its inner four
/// nodes a polynomial is less exact.
constexpr double share_aside = 0.55;
/// The ratio of a third difference to that of probe rays half as far apart, at the most: about 8
/// where it is even, and more where it changes.
constexpr double by_halving = 20.0;
/// Coarse cells that are decided together, about: their probe rays fill the lanes.
constexpr int cells_at_once = 96;
/// Kinds that probe rays are compared with before all is forgotten.
constexpr std::size_t max_kinds = 256;
/// Nodes for which there is room from the beginning.
constexpr std::size_t max_room = 2048;

/// The column or row of the first coarse cell that samples of that pixel may lie in.
int cell_before(int pixel) { return (pixel + coarse_spacing - 1) / coarse_spacing; }

double place_of(int node) { return first_node + node * spacing; }

/// A place among cells of one size.
struct Spot {
  int column, row;
  double u, v;  ///< shares of the cell, from its upper left corner
};

Spot spot_in(int stride, const FilmPlace& place) {
  const double cells = 1.0 / (stride * spacing);  // a power of 2: nothing is rounded
  const double x = (place.x - first_node) * cells, y = (place.y - first_node) * cells;
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  return {column, row, x - column, y - row};
}

}  // namespace

SamplingGrid::Patch::Patch(const Cell& cell)
    : found(cell.aside),
      left(place_of(cell.column * cell.stride)),
      top(place_of(cell.row * cell.stride)),
      side(cell.stride * spacing) {}

SamplingGrid::SamplingGrid(const World& world, const BeamGuard& guard, const Window& tile)
    : world_(world), guard_(guard), source_(world) {
  lay_over(tile);
}

void SamplingGrid::lay_over(const Window& tile) {
  tile_ = tile;
  const int column = cell_before(tile.x0), row = cell_before(tile.y0);
  const int columns = cell_before(tile.x1) - column + 1, rows = cell_before(tile.y1) - row + 1;
  settled_ = row;
  pixels_.lay(column, row, columns, rows, {-1.0, -1.0});
  cells_.lay(coarse * column, coarse * row, coarse * columns, coarse * rows, none);
  // The coarse cells and two more about them hold all nodes that are ever asked for.
  std::swap(nodes_, nodes_before_);
  nodes_.lay(coarse * (column - 2), coarse * (row - 2), coarse * (columns + 4) + 1,
             coarse * (rows + 4) + 1, none);
  keep_probe_rays();
  patches_.clear();
  // So that nothing moves while it grows; what is not used costs nothing.
  const std::size_t room = std::min(nodes_.size(), max_room);
  probe_rays_.reserve(room);
  kinds_.reserve(room);
  arrivals_.reserve(room);
  records_.reserve(room);
  patches_.reserve(room);
}

/// Neighbouring tiles are often taken one after the other, and share a tenth of their probe rays.
void SamplingGrid::keep_probe_rays() {
  kept_.clear();
  const int left = std::max(nodes_.left(), nodes_before_.left());
  const int right = std::min(nodes_.right(), nodes_before_.right());
  const int bottom = std::min(nodes_.bottom(), nodes_before_.bottom());
  // Kinds are searched one by one: when there are too many, all is forgotten.
  const bool keeps = left < right && known_kinds_.size() <= max_kinds;
  if (!keeps) known_kinds_.clear();
  for (int row = std::max(nodes_.top(), nodes_before_.top()); keeps && row < bottom; ++row) {
    const std::uint32_t* const before = &nodes_before_.at(left, row);
    std::uint32_t* const here = &nodes_.at(left, row);
    for (int i = 0; i < right - left; ++i)
      if (before[i] != none) kept_.push_back({before[i], here + i});
  }
  std::sort(kept_.begin(), kept_.end(),
            [](const Kept& a, const Kept& b) { return a.probe_ray < b.probe_ray; });
  for (std::uint32_t to = 0; to < kept_.size(); ++to) {
    const std::uint32_t from = kept_[to].probe_ray;
    *kept_[to].node = to;
    if (from == to) continue;
    probe_rays_[to] = probe_rays_[from];
    arrivals_[to] = arrivals_[from];
    kinds_[to] = kinds_[from];
    records_[to] = records_[from];
  }
  probe_rays_.resize(kept_.size());
  arrivals_.resize(kept_.size());
  kinds_.resize(kept_.size());
}

bool SamplingGrid::holds_samples(const Cell& cell) const {
  const double side = cell.stride * spacing, left = place_of(cell.column * cell.stride),
               top = place_of(cell.row * cell.stride);
  // One sample alone lies in the centre of its pixel.
  const double first = world_.sampling.samples == 1 ? 0.5 : 0.0;
  return left + side > tile_.x0 + first && left < tile_.x1 && top + side > tile_.y0 + first &&
         top < tile_.y1;
}

void SamplingGrid::settle_from(int row, Tally& tally) {
  const int columns = pixels_.right() - pixels_.left();
  const int end = std::min(pixels_.bottom(), row + std::max(1, cells_at_once / columns));
  undecided_.clear();
  for (int j = row; j < end; ++j)
    for (int i = pixels_.left(); i < pixels_.right(); ++i)
      if (const Cell cell{coarse, i, j}; holds_samples(cell)) undecided_.push_back(cell);
  while (!undecided_.empty()) {
    send_probe_rays(tally);
    next_.clear();
    for (const Cell& cell : undecided_) decide(cell);
    std::swap(undecided_, next_);
  }
  settled_ = end;
}

void SamplingGrid::want_probe_rays(bool finest) {
  for (const Cell& cell : undecided_) {
    if ((cell.stride == 1) != finest) continue;
    const int left = (cell.column + cell.aside.right - 1) * cell.stride;
    const int top = (cell.row + cell.aside.down - 1) * cell.stride;
    for (int row = top; row < top + 4 * cell.stride; row += cell.stride) {
      std::uint32_t* const probe_rays = &nodes_.at(left, row);
      for (int i = 0; i < 4 * cell.stride; i += cell.stride) {
        if (probe_rays[i] != none) continue;
        probe_rays[i] = static_cast<std::uint32_t>(probe_rays_.size() + aims_.size());
        aims_.push_back({place_of(left + i), place_of(row)});
      }
    }
  }
}

void SamplingGrid::send_probe_rays(Tally& tally) {
  aims_.clear();
  want_probe_rays(false);
  // The smallest cells are quarters of clear cells, so the guard needs no path records of theirs.
  // Without portals in the scene nothing else does.
  const std::size_t silent_from = aims_.size();
  want_probe_rays(true);
  const std::size_t first = probe_rays_.size(), count = aims_.size();
  if (count == 0) return;
  const std::size_t told = world_.space.portals.portals().empty() ? silent_from : count;
  probe_rays_.resize(first + count);
  arrivals_.resize(first + count);
  kinds_.resize(first + count);
  if (records_.size() < probe_rays_.size()) records_.resize(probe_rays_.size());
  const auto photons = std::span(probe_rays_).subspan(first);
  source_.send(aims_, photons);
  advance_with_records(world_.space, photons, std::span(arrivals_).subspan(first),
                       std::span(records_).subspan(first, told));
  for (std::size_t i = 0; i < count; ++i) {
    const PathRecord& record = records_[first + i];
    const bool known = i >= told || record.known();
    kinds_[first + i] =
        known ? kind_of(arrivals_[first + i], i < told ? record.portals() : 0) : none;
  }
  tally.probe_rays += count;
}

/// Few are seen within a tile, and neighbours are often of one.
std::uint32_t SamplingGrid::kind_of(const Arrival& arrival, std::uint64_t portals) {
  if (!Bicubic::can_tell(world_.space, arrival)) return none;
  const Kind kind{arrival.fate, arrival.met,       arrival.object,
                  arrival.face, arrival.crossings, portals};
  std::size_t i = known_kinds_.size();
  while (i > 0 && !(known_kinds_[i - 1] == kind)) --i;
  if (i == 0) {
    known_kinds_.push_back(kind);
    i = known_kinds_.size();
  }
  return static_cast<std::uint32_t>(i - 1);
}

const PixelSpan& SamplingGrid::pixel_in(int column, int row) {
  PixelSpan& pixel = pixels_.at(column, row);
  if (pixel.angle >= 0.0) return pixel;
  const auto corner = [&](int k) -> const Photon& {
    return probe_rays_[nodes_.at((column + k % 2) * coarse, (row + k / 2) * coarse)];
  };
  double angle = std::numeric_limits<double>::infinity(), aside = angle;
  for (const auto& [a, b] : {std::pair{0, 1}, std::pair{0, 2}, std::pair{1, 3}, std::pair{2, 3}}) {
    const Vec3d turned = corner(a).direction - corner(b).direction;
    const Vec3d moved = corner(a).position - corner(b).position;
    angle = std::min(angle, dot(turned, turned));
    aside = std::min(aside, dot(moved, moved));
  }
  return pixel = {std::sqrt(angle) / coarse_spacing, std::sqrt(aside) / coarse_spacing};
}

void SamplingGrid::decide(const Cell& cell) {
  const auto corner = [&](int i, int j) {
    return nodes_.at((cell.column + i) * cell.stride, (cell.row + j) * cell.stride);
  };
  const std::uint32_t first = corner(0, 0);  // of the cell, wherever its probe rays lie
  Kinds kinds;
  Bicubic::ProbeRays probe_rays;
  bool agree = kinds_[first] != none;
  for (int j = 0; j < 4; ++j) {
    const std::uint32_t* const row = &nodes_.at((cell.column + cell.aside.right - 1) * cell.stride,
                                                (cell.row + cell.aside.down + j - 1) * cell.stride);
    for (int i = 0; i < 4; ++i) {
      const std::uint32_t probe_ray = row[std::ptrdiff_t{i} * cell.stride];
      probe_rays[j][i] = &arrivals_[probe_ray];
      kinds[j][i] = kinds_[probe_ray];
      agree = agree && kinds[j][i] == kinds_[first];
    }
  }
  if (!agree) return look_aside(cell, kinds);
  const int share = coarse / cell.stride;
  const double given_up = cell.stride > 1 ? by_halving : 1.0;
  const double most =
      max_third_difference(world_.space, cell.stride) * (cell.aside.is_none() ? 1.0 : share_aside);
  Patch& patch = patches_.emplace_back(cell);
  const double roughness = patch.found.through(
      world_.space, probe_rays, pixel_in(cell.column / share, cell.row / share), most, given_up);
  const auto clear = [&] {
    return guard_.clear({&records_[first], &records_[corner(1, 0)], &records_[corner(0, 1)],
                         &records_[corner(1, 1)]},
                        arrivals_[first]);
  };
  const bool usable = roughness <= given_up && (cell.clear || clear());
  if (usable && roughness <= 1.0) {
    for (int j = 0; j < cell.stride; ++j)
      for (int i = 0; i < cell.stride; ++i)
        cells_.at(cell.column * cell.stride + i, cell.row * cell.stride + j) =
            static_cast<std::uint32_t>(patches_.size() - 1);
    return;
  }
  patches_.pop_back();
  if (usable || cell.stride == coarse) halve(cell, usable);
}

/// Beside an edge of what is seen, sixteen may agree that lie further from it. Of the smallest
/// cells there are too many.
void SamplingGrid::look_aside(const Cell& cell, const Kinds& kinds) {
  if (cell.stride == 1) return;
  constexpr NodeStep steps[] = {{-1, 0},  {1, 0},  {0, -1}, {0, 1},
                                {-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
  for (const NodeStep& step : steps) {
    bool all = cell.aside.is_none() && kinds[1][1] != none;
    for (int j = std::max(0, step.down); j < std::min(4, 4 + step.down); ++j)
      for (int i = std::max(0, step.right); i < std::min(4, 4 + step.right); ++i)
        all = all && kinds[j][i] == kinds[1][1];
    if (!all) continue;
    next_.push_back({cell.stride, cell.column, cell.row, cell.clear, step});
    return;
  }
  if (cell.stride == coarse) halve(cell, false);
}

void SamplingGrid::halve(const Cell& cell, bool clear) {
  for (int j = 2 * cell.row; j < 2 * cell.row + 2; ++j)
    for (int i = 2 * cell.column; i < 2 * cell.column + 2; ++i)
      if (const Cell half{cell.stride / 2, i, j, clear}; holds_samples(half)) next_.push_back(half);
}

std::uint32_t SamplingGrid::probe_ray_at(const FilmPlace& place) const {
  const Spot spot = spot_in(1, place);
  return spot.u == 0.0 && spot.v == 0.0 ? nodes_.at(spot.column, spot.row) : none;
}

const SamplingGrid::Patch* SamplingGrid::patch_at(const FilmPlace& place) const {
  const Spot spot = spot_in(1, place);
  const std::uint32_t patch = cells_.at(spot.column, spot.row);
  return patch == none ? nullptr : &patches_[patch];
}

void SamplingGrid::advance(std::span<const FilmPlace> places, std::span<Arrival> arrivals,
                           Tally& tally) {
  left_.clear();
  for (std::size_t i = 0; i < places.size();) {
    while (spot_in(coarse, places[i]).row >= settled_)
      settle_from(std::max(settled_, cell_before(static_cast<int>(places[i].y))), tally);
    const Patch* patch = patch_at(places[i]);
    if (!patch) {
      if (const std::uint32_t probe_ray = probe_ray_at(places[i]); probe_ray != none)
        arrivals[i] = arrivals_[probe_ray];
      else
        left_.push_back(static_cast<std::uint32_t>(i));
      ++i;
      continue;
    }
    // Samples come along rows of pixels: with one in each, a cell's row is worked out once.
    const double y = places[i].y, end = patch->left + patch->side, share = 1.0 / patch->side;
    const Bicubic::Row row(patch->found, (y - patch->top) * share);
    const std::size_t first = i;
    for (; i < places.size() && places[i].y == y && places[i].x >= patch->left && places[i].x < end;
         ++i)
      row.tell((places[i].x - patch->left) * share, arrivals[i]);
    tally.interpolated += i - first;
  }
  send_left(places, arrivals);
}

void SamplingGrid::send_left(std::span<const FilmPlace> places, std::span<Arrival> arrivals) {
  own_.resize(left_.size());
  found_.resize(left_.size());
  aims_.clear();
  for (const std::uint32_t i : left_) aims_.push_back(places[i]);
  source_.send(aims_, own_);
  portalens::advance(world_.space, own_, found_);
  for (std::size_t i = 0; i < left_.size(); ++i) arrivals[left_[i]] = found_[i];
}

}  // namespace portalens
