/// \file
/// The masses of a crowd, and the grid by which lanes find those near them.
#pragma once

#include <cstdint>
#include <vector>

#include "photon/lane_scene.h"

namespace portalens {

/// Owns what a `LaneCrowd` points at.
class CrowdGrid {
 public:
  CrowdGrid() = default;
  /// Lays the balls in which masses act or absorb into cubes: as small as pays, and as few as keep
  /// within 20 bytes each for about a million entries and `most_lane_crowd` more.
  /// @pre no more than `most_lane_crowd` masses, with finite radii
  explicit CrowdGrid(std::vector<LaneMass> masses);

  /// @return what lives as long as this object stays where it is
  [[nodiscard]] LaneCrowd view() const;

 private:
  /// The cubes from `low` to `high` on one axis that a ball may meet.
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
  double low_[3] = {}, size_ = 1.0, slack_ = 0.0;
  int cells_[3] = {};
  std::vector<std::uint32_t> begins_, which_;
  std::vector<float> x_, y_, z_, reach2_;
};

}  // namespace portalens
