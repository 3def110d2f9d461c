#include "lanes/mass_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace portalens {
namespace {

/// The side of a cube, as a share of the usual radius. Measured: smaller ones hold fewer balls that
/// a place in them does not lie in, larger ones are crossed in fewer steps.
constexpr double size_share = 1.5;
constexpr double max_entries = 1 << 20;
constexpr double max_cells = 1 << 18;
/// Balls reach that much farther, in cubes: no rounding of a place leads past them.
constexpr double slack_share = 1e-2;

float radius_of(const LaneMass& mass) { return std::max(mass.influence, mass.horizon); }

}  // namespace

MassGrid::MassGrid(std::vector<LaneMass> masses) : masses_(std::move(masses)) {
  choose_size();
  fill();
}

double MassGrid::reach(const LaneMass& mass) const { return radius_of(mass) + slack_share * size_; }

void MassGrid::choose_size() {
  double low[3], high[3];
  std::fill_n(low, 3, std::numeric_limits<double>::infinity());
  std::fill_n(high, 3, -std::numeric_limits<double>::infinity());
  std::vector<float> radii;
  for (const LaneMass& mass : masses_) {
    const float center[3] = {mass.center.x, mass.center.y, mass.center.z};
    radii.push_back(radius_of(mass));
    for (int a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], double{center[a]} - radii.back());
      high[a] = std::max(high[a], double{center[a]} + radii.back());
    }
  }
  const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
  std::nth_element(radii.begin(), middle, radii.end());
  const double widest = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  size_ = std::max(size_share * *middle, 1e-3 * widest);
  if (!(size_ > 0.0)) size_ = 1.0;  // nothing acts anywhere
  for (;; size_ *= 1.25) {
    double cells = 1.0, entries = 0.0;
    for (int a = 0; a < 3; ++a) {
      cells_[a] = 1 + static_cast<int>((high[a] - low[a]) / size_ + 2.0 * slack_share);
      low_[a] = low[a] - slack_share * size_;
      cells *= cells_[a];
    }
    if (cells > max_cells) continue;
    for (const LaneMass& mass : masses_) entries += range_of(mass).volume();
    if (entries <= max_entries || cells == 1.0) return;
  }
}

double MassGrid::Range::volume() const {
  double product = 1.0;
  for (int a = 0; a < 3; ++a) product *= high[a] - low[a] + 1;
  return product;
}

MassGrid::Range MassGrid::range_of(const LaneMass& mass) const {
  const float center[3] = {mass.center.x, mass.center.y, mass.center.z};
  Range range;
  for (int a = 0; a < 3; ++a) {
    const auto cell = [&](double x) {
      return static_cast<int>(std::clamp((x - low_[a]) / size_, 0.0, cells_[a] - 1.0));
    };
    range.low[a] = cell(center[a] - reach(mass));
    range.high[a] = cell(center[a] + reach(mass));
  }
  return range;
}

bool MassGrid::meets(const LaneMass& mass, int i, int j, int k) const {
  const float center[3] = {mass.center.x, mass.center.y, mass.center.z};
  const int cell[3] = {i, j, k};
  double square = 0.0;
  for (int a = 0; a < 3; ++a) {
    const double from = low_[a] + cell[a] * size_;
    const double off = center[a] - std::clamp(double{center[a]}, from, from + size_);
    square += off * off;
  }
  return square <= reach(mass) * reach(mass);
}

template <class Callback>
void MassGrid::for_each_cell(const LaneMass& mass, const Callback& callback) const {
  const Range range = range_of(mass);
  for (int k = range.low[2]; k <= range.high[2]; ++k)
    for (int j = range.low[1]; j <= range.high[1]; ++j) {
      const std::ptrdiff_t row = std::ptrdiff_t{k} * cells_[1] + j;
      for (int i = range.low[0]; i <= range.high[0]; ++i)
        if (meets(mass, i, j, k)) callback(static_cast<std::size_t>(row * cells_[0] + i));
    }
}

void MassGrid::fill() {
  begins_.assign(static_cast<std::size_t>(cells_[0]) * cells_[1] * cells_[2] + 1, 0);
  for (const LaneMass& mass : masses_)
    for_each_cell(mass, [&](std::size_t cell) { ++begins_[cell + 1]; });
  for (std::size_t cell = 1; cell < begins_.size(); ++cell) begins_[cell] += begins_[cell - 1];
  const std::size_t entries = begins_.back(), room = entries + lane_count;
  which_.resize(entries);
  for (auto* column : {&x_, &y_, &z_, &reach2_}) column->assign(room, 0.0f);
  std::vector<std::uint32_t> next(begins_.begin(), begins_.end() - 1);
  for (std::uint32_t i = 0; i < masses_.size(); ++i) {
    const LaneMass& mass = masses_[i];
    for_each_cell(mass, [&](std::size_t cell) {
      const std::uint32_t at = next[cell]++;
      which_[at] = i;
      x_[at] = mass.center.x;
      y_[at] = mass.center.y;
      z_[at] = mass.center.z;
      reach2_[at] = mass.horizon > mass.influence ? mass.horizon2 : mass.influence2;
    });
  }
}

LaneManyMasses MassGrid::view() const {
  return {static_cast<int>(masses_.size()),
          masses_.data(),
          cells_[0],
          cells_[1],
          cells_[2],
          {static_cast<float>(low_[0]), static_cast<float>(low_[1]), static_cast<float>(low_[2])},
          static_cast<float>(size_),
          static_cast<float>(1.0 / size_),
          begins_.data(),
          x_.data(),
          y_.data(),
          z_.data(),
          reach2_.data(),
          which_.data()};
}

}  // namespace portalens
