#include "geometry/distance_grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace portalens {
namespace {

constexpr int least_cells = 16, max_cells = 96;  ///< along the longest side of the box
constexpr double cells_a_triangle = 64.0;
constexpr double parts = 4.0;  ///< of a cell's side, that distances are told in

using CellIndex = std::array<int, 3>;

/// Counts, for each cell, the boxes that it meets.
class Cover {
 public:
  explicit Cover(CellIndex count)
      : count_(count),
        sums_(static_cast<std::size_t>(count[0] + 1) * static_cast<std::size_t>(count[1] + 1) *
              static_cast<std::size_t>(count[2] + 1)) {}

  /// Takes a box of cells, both ends included, whatever its size at the same cost: differences are
  /// noted at its corners, and summed up in the end.
  void add(const CellIndex& low, const CellIndex& high) {
    for (int corner = 0; corner < 8; ++corner) {
      const bool x = corner & 1, y = corner & 2, z = corner & 4;
      sums_[at(x ? high[0] + 1 : low[0], y ? high[1] + 1 : low[1], z ? high[2] + 1 : low[2])] +=
          x ^ y ^ z ? ~std::uint32_t{0} : 1u;
    }
  }

  /// 0 where a box meets the cell, else `otherwise`; x fastest.
  [[nodiscard]] std::vector<std::uint32_t> covered(std::uint32_t otherwise) {
    for (int z = 0; z <= count_[2]; ++z)
      for (int y = 0; y <= count_[1]; ++y)
        for (int x = 1; x <= count_[0]; ++x) sums_[at(x, y, z)] += sums_[at(x - 1, y, z)];
    for (int z = 0; z <= count_[2]; ++z)
      for (int y = 1; y <= count_[1]; ++y)
        for (int x = 0; x <= count_[0]; ++x) sums_[at(x, y, z)] += sums_[at(x, y - 1, z)];
    std::vector<std::uint32_t> cells;
    for (int z = 0; z < count_[2]; ++z)
      for (int y = 0; y < count_[1]; ++y)
        for (int x = 0; x < count_[0]; ++x) {
          if (z > 0) sums_[at(x, y, z)] += sums_[at(x, y, z - 1)];
          cells.push_back(sums_[at(x, y, z)] != 0 ? 0 : otherwise);
        }
    return cells;
  }

 private:
  [[nodiscard]] std::size_t at(int x, int y, int z) const {
    return static_cast<std::size_t>(x) +
           static_cast<std::size_t>(count_[0] + 1) *
               (static_cast<std::size_t>(y) +
                static_cast<std::size_t>(count_[1] + 1) * static_cast<std::size_t>(z));
  }

  CellIndex count_;
  std::vector<std::uint32_t> sums_;
};

/// Adds the boxes of pieces of a triangle, which is halved as often where they would be large.
/// @param cells_met  of a box: the first cells that it meets, and the last, each way
template <class CellsMet>
void cover_triangle(Cover& cover, const CellsMet& cells_met, const std::array<Vec3d, 3>& t,
                    int halvings) {
  Box around;
  for (const Vec3d& corner : t) around.add(corner);
  const auto [from, to] = cells_met(around);
  const int met = (to[0] - from[0] + 1) * (to[1] - from[1] + 1) * (to[2] - from[2] + 1);
  if (halvings == 0 || met <= 4) return cover.add(from, to);
  std::size_t longest = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (length(t[(i + 1) % 3] - t[i]) > length(t[(longest + 1) % 3] - t[longest])) longest = i;
  const Vec3d a = t[longest], b = t[(longest + 1) % 3], c = t[(longest + 2) % 3];
  const Vec3d middle = (a + b) * 0.5;
  cover_triangle(cover, cells_met, {a, middle, c}, halvings - 1);
  cover_triangle(cover, cells_met, {middle, b, c}, halvings - 1);
}

/// What lies between two cells of a line, in sides of a cell, squared.
std::uint32_t gap2(int apart) {
  const auto between = static_cast<std::uint32_t>(std::max(apart - 1, 0));
  return between * between;
}

/// The least of value + gap² over each line of cells along one axis, for each of its cells.
void spread_along(std::vector<std::uint32_t>& cells, std::size_t stride, int count) {
  std::vector<std::uint32_t> line(static_cast<std::size_t>(count));
  const auto value = [&](int place) { return line[static_cast<std::size_t>(place)]; };
  for (std::size_t first = 0; first < cells.size(); ++first) {
    if (first / stride % static_cast<std::size_t>(count) != 0) continue;
    for (int i = 0; i < count; ++i)
      line[static_cast<std::size_t>(i)] = cells[first + static_cast<std::size_t>(i) * stride];
    for (int i = 0; i < count; ++i) {
      std::uint32_t least = value(i);
      for (int apart = 1; apart < count && gap2(apart) < least; ++apart) {
        if (i >= apart) least = std::min(least, value(i - apart) + gap2(apart));
        if (i + apart < count) least = std::min(least, value(i + apart) + gap2(apart));
      }
      cells[first + static_cast<std::size_t>(i) * stride] = least;
    }
  }
}

}  // namespace

inline std::array<int, 3> DistanceGrid::cell_at(Vec3d x) const {
  const auto along = [this](double from_low, int count) {
    return static_cast<int>(std::clamp(from_low * per_cell_, 0.0, count - 1.0));
  };
  const Vec3d d = x - low_;
  return {along(d.x, count_[0]), along(d.y, count_[1]), along(d.z, count_[2])};
}

DistanceGrid::DistanceGrid(const Mesh& mesh) {
  const Box box = mesh.bounds();
  low_ = box.low, high_ = box.high;
  slack_ = 1e-12 * (box.diagonal() + length(box.middle()));
  const Vec3d size = high_ - low_;
  const auto triangles = static_cast<double>(mesh.triangle_count());
  const double along = std::clamp(std::cbrt(cells_a_triangle * triangles),
                                  static_cast<double>(least_cells), static_cast<double>(max_cells));
  cell_ = std::max({size.x, size.y, size.z}) / std::floor(along);
  per_cell_ = 1.0 / cell_;
  const auto cells_of = [&](double side) {
    return std::clamp(static_cast<int>(std::ceil(side / cell_)), 1, max_cells);
  };
  count_ = {cells_of(size.x), cells_of(size.y), cells_of(size.z)};

  // Boxes of large triangles would cover much that these don't meet.
  const int halvings = std::clamp(22 - static_cast<int>(std::log2(triangles)), 0, 12);
  Cover cover(count_);
  const auto cells_met = [this](const Box& piece) {
    const Box grown = piece.grown(slack_);
    return std::pair(cell_at(grown.low), cell_at(grown.high));
  };
  for (std::uint32_t face = 0; face < mesh.triangle_count(); ++face)
    cover_triangle(cover, cells_met, mesh.triangle(face), halvings);

  // So far that no sum of gaps is as much, nor overflows.
  std::vector<std::uint32_t> cells = cover.covered(3u * max_cells * max_cells);
  std::size_t stride = 1;
  for (const int count : count_) {
    spread_along(cells, stride, count);
    stride *= static_cast<std::size_t>(count);
  }
  free_.reserve(cells.size());
  for (const std::uint32_t square : cells)
    free_.push_back(static_cast<std::uint8_t>(
        std::min(std::floor(parts * std::sqrt(static_cast<double>(square))), 255.0)));
}

double DistanceGrid::clearance(Vec3d x) const {
  const Vec3d inside{std::clamp(x.x, low_.x, high_.x), std::clamp(x.y, low_.y, high_.y),
                     std::clamp(x.z, low_.z, high_.z)};
  const CellIndex at = cell_at(inside);
  const int index = at[0] + count_[0] * (at[1] + count_[1] * at[2]);
  const double free = free_[static_cast<std::size_t>(index)] * (cell_ / parts);
  // Seen from outside, the mesh lies behind the plane through `inside` across the path there.
  const Vec3d out = x - inside;
  const double away2 = dot(out, out);
  return std::max(0.0, (away2 > 0.0 ? std::sqrt(away2 + free * free) : free) - slack_);
}

double DistanceGrid::free_until(const Ray& ray, double low, double high, double radius) const {
  constexpr int max_strides = 16;
  const double worth = 0.5 * cell_;
  // More than rounding can make of places on the ray.
  const double blur =
      1e-14 * (std::fabs(ray.origin.x) + std::fabs(ray.origin.y) + std::fabs(ray.origin.z) + high);
  for (int i = 0; i < max_strides; ++i) {
    const double free = clearance(ray.at(low)) - radius - blur;
    if (!(free > worth)) return low;
    low += free;
    if (low > high) return low;
  }
  return low;
}

}  // namespace portalens
