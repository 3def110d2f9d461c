/// \file
/// More masses than `LaneMasses` holds, and the grid by which lanes find those near them.
#pragma once

#include <cstdint>
#include <vector>

#include "lanes/scene.h"

namespace portalens {

/// Owns what a `LaneManyMasses` points at.
class MassGrid {
 public:
  MassGrid() = default;
  /// Lays the balls in which masses act or absorb into cubes: as small as pays, and as few as keep
  /// within 20 bytes each for about a million entries and `max_lane_many` more.
  /// @pre no more than `max_lane_many` masses, with finite radii
  explicit MassGrid(std::vector<LaneMass> masses);

  /// @return what lives as long as this object stays where it is
  [[nodiscard]] LaneManyMasses view() const;

 private:
  /// The cubes that a ball may meet: from `low` to `high` on each of the three axes.
  struct Range {
    int low[3], high[3];
    [[nodiscard]] double volume() const;
  };
  void choose_size();
  void fill();
  [[nodiscard]] double reach(const LaneMass& mass) const;
  [[nodiscard]] Range range_of(const LaneMass& mass) const;
  [[nodiscard]] bool meets(const LaneMass& mass, int i, int j, int k) const;
  template <class Callback>
  void for_each_cell(const LaneMass& mass, const Callback& callback) const;

  std::vector<LaneMass> masses_;
  double low_[3] = {}, size_ = 1.0;
  int cells_[3] = {};
  std::vector<std::uint32_t> begins_, which_;
  std::vector<float> x_, y_, z_, reach2_;
};

}  // namespace portalens
