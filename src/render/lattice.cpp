#include "render/lattice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "photon/engine.h"

namespace portalens {
namespace {

/// Pixels between two nodes.
constexpr int spacing = 2;
/// And between those of the coarsest cells.
constexpr int coarse_spacing = 4 * spacing;
/// Where the first node lies: nodes are centres of pixels, and no sample lies before the first.
constexpr double first_node = 0.5 - coarse_spacing;

/// Third differences of what guides find, pixels: those of a function that is a polynomial of the
/// third degree but for hundredths of a pixel. What masses do by themselves is smooth between the
/// borders that the guard looks for; gravity through portals bends sharply at more than those.
double most_third_difference(const Space& space) {
  return std::holds_alternative<NoCoupling>(space.coupling) ? 4.0 : 0.5;
}

/// As much of that where the guides lie aside: beyond the inner four a polynomial is worth less.
constexpr double share_aside = 0.5;
/// Of a third difference to that of guides half as far apart: about 8, and more where it changes.
constexpr double by_halving = 20.0;
/// Coarse cells that are decided together, about: their guides fill the lanes.
constexpr int cells_at_once = 96;
/// Kinds that guides of a tile are compared with before all is forgotten.
constexpr std::size_t most_kinds = 256;
/// Nodes for which there is room from the beginning.
constexpr std::size_t most_room = 2048;

/// The column or row of the first coarse cell that samples of that pixel may lie in.
int cell_before(int pixel) { return (pixel + coarse_spacing - 1) / coarse_spacing; }

double place_of(int node) { return first_node + node * spacing; }

}  // namespace

void Lattice::Level::clear(int column, int row, int column_count, int row_count) {
  first_column = column;
  first_row = row;
  columns = column_count;
  rows = row_count;
  smooth.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), none);
}

void Lattice::Nodes::clear(int column, int row, int column_count, int row_count) {
  first_column = column;
  first_row = row;
  columns = column_count;
  rows = row_count;
  guides.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), none);
}

Lattice::Lattice(const World& world, const BeamGuard& guard, const Window& tile)
    : world_(world), guard_(guard), source_(world) {
  lay_over(tile);
}

void Lattice::lay_over(const Window& tile) {
  tile_ = tile;
  const int column = cell_before(tile.x0), row = cell_before(tile.y0);
  const int columns = cell_before(tile.x1) - column + 1, rows = cell_before(tile.y1) - row + 1;
  for (Level& level : levels_) {
    const int share = levels_[0].stride / level.stride;
    level.clear(share * column, share * row, share * columns, share * rows);
  }
  pixels_.assign(levels_[0].smooth.size(), {-1.0, -1.0});
  settled_ = row;
  // The coarse cells and two more about them hold all nodes that are ever asked for.
  const int stride = levels_[0].stride;
  std::swap(nodes_, nodes_before_);
  nodes_.clear(stride * (column - 2), stride * (row - 2), stride * (columns + 4) + 1,
               stride * (rows + 4) + 1);
  keep_guides(nodes_before_);
  smooth_.clear();
  own_places_.clear();
  taken_ = 0;
  // So that nothing moves while it grows; what is not used costs nothing.
  const std::size_t room = std::min(nodes_.guides.size(), most_room);
  guides_.reserve(room);
  kinds_.reserve(room);
  arrivals_.reserve(room);
  trails_.reserve(room);
  smooth_.reserve(room);
}

/// Neighbouring tiles are often taken one after the other, and share a fifth of their guides.
void Lattice::keep_guides(Nodes& before) {
  const int left = std::max(nodes_.first_column, before.first_column);
  const int right =
      std::min(nodes_.first_column + nodes_.columns, before.first_column + before.columns);
  const int top = std::max(nodes_.first_row, before.first_row);
  const int bottom = std::min(nodes_.first_row + nodes_.rows, before.first_row + before.rows);
  kept_.assign(guides_.size(), none);
  if (known_kinds_.size() > most_kinds) {  // they are searched one by one
    known_kinds_.clear();
    before.guides.assign(before.guides.size(), none);
  }
  const auto for_shared_nodes = [&](const auto& action) {
    for (int row = top; row < bottom; ++row)
      for (int column = left; column < right; ++column)
        if (const std::uint32_t guide = before.at(column, row); guide != none)
          action(column, row, guide);
  };
  for_shared_nodes([&](int, int, std::uint32_t guide) { kept_[guide] = guide; });
  std::uint32_t count = 0;
  for (std::size_t guide = 0; guide < kept_.size(); ++guide) {
    if (kept_[guide] == none) continue;
    kept_[guide] = count;
    guides_[count] = guides_[guide];
    arrivals_[count] = arrivals_[guide];
    kinds_[count] = kinds_[guide];
    std::swap(trails_[count], trails_[guide]);
    ++count;
  }
  for_shared_nodes(
      [&](int column, int row, std::uint32_t guide) { node(column, row) = kept_[guide]; });
  kinds_.resize(count);
  guides_.resize(count);
  arrivals_.resize(count);
}

Lattice::Spot Lattice::spot_in(const Level& level, const FilmPlace& place) {
  const double cells = 1.0 / (level.stride * spacing);  // a power of 2: nothing is rounded
  const double x = (place.x - first_node) * cells, y = (place.y - first_node) * cells;
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  return {column, row, x - column, y - row};
}

void Lattice::want_guide(int column, int row) {
  std::uint32_t& guide = node(column, row);
  if (guide != none) return;
  guide = static_cast<std::uint32_t>(guides_.size() + aims_.size());
  aims_.push_back({place_of(column), place_of(row)});
}

void Lattice::send_guides(Tally& tally) {
  aims_.clear();
  const Cell* before = nullptr;
  for (const Cell& cell : undecided_) {
    // A neighbour on the left has all but the last column.
    const bool beside = before && before->level == cell.level && before->row == cell.row &&
                        before->column + 1 == cell.column && before->aside == cell.aside;
    const int stride = levels_[cell.level].stride;
    for (int j = cell.aside.down - 1; j < cell.aside.down + 3; ++j)
      for (int i = cell.aside.right + (beside ? 2 : -1); i < cell.aside.right + 3; ++i)
        want_guide((cell.column + i) * stride, (cell.row + j) * stride);
    before = &cell;
  }
  const std::size_t first = guides_.size(), count = aims_.size();
  if (count == 0) return;
  guides_.resize(first + count);
  arrivals_.resize(first + count);
  kinds_.resize(first + count);
  const auto photons = std::span(guides_).subspan(first);
  source_.send(aims_, photons);
  const auto arrivals = std::span(arrivals_).subspan(first);
  if (trails_.size() < guides_.size()) trails_.resize(guides_.size());
  advance_with_trails(world_.space, photons, arrivals, std::span(trails_).subspan(first, count));
  for (std::size_t i = first; i < guides_.size(); ++i)
    kinds_[i] = trails_[i].known() ? kind_of(arrivals_[i], trails_[i].portals()) : none;
  tally.guides += count;
}

const PixelSpan& Lattice::pixel_in(int column, int row) {
  PixelSpan& pixel = pixels_[levels_[0].index(column, row)];
  if (pixel.angle >= 0.0) return pixel;
  const int stride = levels_[0].stride;
  const auto corner = [&](int k) -> const Photon& {
    return guides_[node((column + k % 2) * stride, (row + k / 2) * stride)];
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

/// Few are seen within a tile, and neighbours are often of one.
std::uint32_t Lattice::kind_of(const Arrival& arrival, std::uint64_t portals) {
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

void Lattice::decide(const Cell& cell) {
  Level& level = levels_[cell.level];
  const auto corner = [&](int i, int j) {
    return node((cell.column + i) * level.stride, (cell.row + j) * level.stride);
  };
  const std::uint32_t first = corner(0, 0);
  Kinds kinds;
  Bicubic::Guides guides;
  bool agree = kinds_[first] != none;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      const std::uint32_t guide = corner(cell.aside.right + i - 1, cell.aside.down + j - 1);
      guides[j][i] = &arrivals_[guide];
      kinds[j][i] = kinds_[guide];
      agree = agree && kinds[j][i] == kinds_[first];
    }
  if (!agree) return look_aside(cell, kinds);
  const int share = levels_[0].stride / level.stride;
  const PixelSpan& pixel = pixel_in(cell.column / share, cell.row / share);
  const bool finest = cell.level + 1 == levels_.size();
  const double halved = finest ? 1.0 : by_halving;
  const double most =
      most_third_difference(world_.space) * (cell.aside.is_none() ? 1.0 : share_aside);
  const double roughness =
      smooth_.emplace_back(cell.aside).through(world_.space, guides, pixel, most, halved);
  const auto clear = [&] {
    return guard_.clear(
        {&trails_[first], &trails_[corner(1, 0)], &trails_[corner(0, 1)], &trails_[corner(1, 1)]},
        arrivals_[first]);
  };
  const bool usable = roughness <= halved && (cell.clear || clear());
  if (usable && roughness <= 1.0) {
    level.smooth[level.index(cell.column, cell.row)] =
        static_cast<std::uint32_t>(smooth_.size() - 1);
    return;
  }
  smooth_.pop_back();
  if (usable || cell.level == 0) halve(cell, usable);
}

/// Beside an edge of what is seen, sixteen may agree that lie further from it. The largest cells
/// are better halved, and of the smallest are too many.
void Lattice::look_aside(const Cell& cell, const Kinds& kinds) {
  if (cell.level == 0) return halve(cell, false);
  if (cell.level + 1 == levels_.size() || !cell.aside.is_none() || kinds[1][1] == none) return;
  constexpr NodeStep steps[] = {{-1, 0},  {1, 0},  {0, -1}, {0, 1},
                                {-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
  for (const NodeStep& step : steps) {
    bool all = true;
    for (int j = std::max(0, step.down); j < std::min(4, 4 + step.down); ++j)
      for (int i = std::max(0, step.right); i < std::min(4, 4 + step.right); ++i)
        all = all && kinds[j][i] == kinds[1][1];
    if (!all) continue;
    next_.push_back({cell.level, cell.column, cell.row, cell.clear, step});
    return;
  }
}

void Lattice::halve(const Cell& cell, bool clear) {
  const std::size_t half = cell.level + 1;
  for (int j = 2 * cell.row; j < 2 * cell.row + 2; ++j)
    for (int i = 2 * cell.column; i < 2 * cell.column + 2; ++i)
      if (holds_samples(levels_[half], i, j)) next_.push_back({half, i, j, clear});
}

bool Lattice::holds_samples(const Level& level, int column, int row) const {
  const double side = level.stride * spacing, left = place_of(column * level.stride),
               top = place_of(row * level.stride);
  // One sample alone lies in the centre of its pixel.
  const double first = is_central() ? 0.5 : 0.0;
  return left + side > tile_.x0 + first && left < tile_.x1 && top + side > tile_.y0 + first &&
         top < tile_.y1;
}

void Lattice::settle_from(int row, Tally& tally) {
  const Level& coarse = levels_[0];
  const int end =
      std::min(coarse.first_row + coarse.rows, row + std::max(1, cells_at_once / coarse.columns));
  undecided_.clear();
  for (int j = row; j < end; ++j)
    for (int i = coarse.first_column; i < coarse.first_column + coarse.columns; ++i)
      if (holds_samples(coarse, i, j)) undecided_.push_back({0, i, j});
  while (!undecided_.empty()) {
    send_guides(tally);
    next_.clear();
    for (const Cell& cell : undecided_) decide(cell);
    std::swap(undecided_, next_);
  }
  settled_ = end;
}

std::uint32_t Lattice::guide_at(const FilmPlace& place) {
  const Spot spot = spot_in(levels_.back(), place);
  return spot.u == 0.0 && spot.v == 0.0 ? node(spot.column, spot.row) : none;
}

Lattice::Patch Lattice::patch_at(const FilmPlace& place) const {
  for (const Level& level : levels_) {
    const Spot spot = spot_in(level, place);
    const std::uint32_t smooth = level.smooth[level.index(spot.column, spot.row)];
    const double side = level.stride * spacing;
    if (smooth != none)
      return {smooth, first_node + spot.column * side, first_node + spot.row * side, side};
  }
  return {none, 0.0, 0.0, 0.0};
}

void Lattice::advance(std::span<const FilmPlace> places, std::span<Arrival> arrivals,
                      Tally& tally) {
  left_.clear();
  for (std::size_t i = 0; i < places.size();) {
    if (spot_in(levels_[0], places[i]).row >= settled_)
      settle_from(std::max(settled_, cell_before(static_cast<int>(places[i].y))), tally);
    const Patch patch = patch_at(places[i]);
    if (patch.smooth == none) {
      if (const std::uint32_t guide = guide_at(places[i]); guide != none)
        arrivals[i] = arrivals_[guide];
      else if (is_central())
        arrivals[i] = own_arrival(places[i], places.size());
      else
        left_.push_back(static_cast<std::uint32_t>(i));
      ++i;
      continue;
    }
    // Samples come along rows of pixels: with one in each, a cell's row is worked out once.
    const double y = places[i].y, end = patch.left + patch.side, share = 1.0 / patch.side;
    const Bicubic::Row row(smooth_[patch.smooth], (y - patch.top) * share);
    const std::size_t first = i;
    for (; i < places.size() && places[i].y == y && places[i].x >= patch.left && places[i].x < end;
         ++i)
      row.tell((places[i].x - patch.left) * share, arrivals[i]);
    tally.interpolated += i - first;
  }
  send_left(places, arrivals);
}

/// Ways of their own are gone many at a time, also those of samples that will be asked for later.
const Arrival& Lattice::own_arrival(const FilmPlace& place, std::size_t at_once) {
  const auto is_before = [](const FilmPlace& a, const FilmPlace& b) {
    return a.y < b.y || (a.y == b.y && a.x < b.x);
  };
  while (taken_ < own_places_.size() && is_before(own_places_[taken_], place)) ++taken_;
  if (taken_ == own_places_.size() || is_before(place, own_places_[taken_])) {
    own_places_.clear();
    taken_ = 0;
    find_own(place, at_once);
    send_own();
  }
  return found_[taken_++];
}

/// @post the first is `from` @pre which is one of them, and most > 0
void Lattice::find_own(const FilmPlace& from, std::size_t most) {
  for (FilmPlace at = from; at.y < tile_.y1 && own_places_.size() < most;
       ++at.y, at.x = tile_.x0 + 0.5) {
    if (spot_in(levels_[0], at).row >= settled_) return;
    while (at.x < tile_.x1 && own_places_.size() < most) {
      const Patch patch = patch_at(at);
      if (patch.smooth == none) {
        if (guide_at(at) == none) own_places_.push_back(at);
        ++at.x;
      } else {
        at.x = patch.left + patch.side;
      }
    }
  }
}

void Lattice::send_own() {
  own_.resize(own_places_.size());
  found_.resize(own_places_.size());
  source_.send(own_places_, own_);
  portalens::advance(world_.space, own_, found_);
}

void Lattice::send_left(std::span<const FilmPlace> places, std::span<Arrival> arrivals) {
  if (left_.empty()) return;
  own_places_.clear();
  for (const std::uint32_t i : left_) own_places_.push_back(places[i]);
  send_own();
  for (std::size_t i = 0; i < left_.size(); ++i) arrivals[left_[i]] = found_[i];
}

}  // namespace portalens
