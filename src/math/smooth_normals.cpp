#include "math/smooth_normals.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <tuple>

#include "math/weld.h"

namespace portalens {
namespace {

/// Corner `i` of triangle `t` has the number `3 t + i`.
using CornerNumber = std::uint32_t;

/// One side of a triangle, by its vertices and its corners there.
struct Side {
  std::uint32_t low, high;
  CornerNumber at_low, at_high;
  bool upwards;  ///< the triangle runs from low to high
};

/// Sets of corners that share a normal.
class CornerSets {
 public:
  explicit CornerSets(std::size_t count) : parent_(count) {
    for (CornerNumber i = 0; i < count; ++i) parent_[i] = i;
  }

  /// The least corner of the set.
  CornerNumber first_of(CornerNumber corner) {
    while (parent_[corner] != corner) {
      parent_[corner] = parent_[parent_[corner]];
      corner = parent_[corner];
    }
    return corner;
  }

  void join(CornerNumber a, CornerNumber b) {
    a = first_of(a), b = first_of(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<CornerNumber> parent_;
};

Vec3d unit_or_zero(Vec3d v) {
  const double size = length(v);
  return size > 0.0 && std::isfinite(size) ? v / size : Vec3d{};
}

class Smoother {
 public:
  Smoother(Triangles& mesh, double crease)
      : mesh_(mesh),
        least_cosine_(std::cos(crease * std::numbers::pi / 180.0)),
        sets_(3 * mesh.corners.size()),
        is_smooth_(mesh.corners.size()) {}

  void run() {
    face_normals_.reserve(mesh_.corners.size());
    for (std::uint32_t face = 0; face < mesh_.corners.size(); ++face)
      face_normals_.push_back(
          unit_or_zero(cross(place(face, 1) - place(face, 0), place(face, 2) - place(face, 0))));
    join_over_smooth_edges();
    add_normals();
  }

 private:
  [[nodiscard]] Vec3d place(std::uint32_t face, std::size_t corner) const {
    return mesh_.positions[mesh_.corners[face][corner].position];
  }

  /// Of all triangles with an area, equal edges side by side.
  [[nodiscard]] std::vector<Side> sides() const {
    const std::vector<std::uint32_t> first = welded(mesh_.positions);
    std::vector<Side> sides;
    sides.reserve(3 * mesh_.corners.size());
    for (std::uint32_t face = 0; face < mesh_.corners.size(); ++face)
      for (std::uint32_t i = 0; i < 3 && face_normals_[face] != Vec3d{}; ++i) {
        const std::uint32_t j = (i + 1) % 3;
        const auto a = first[mesh_.corners[face][i].position];
        const auto b = first[mesh_.corners[face][j].position];
        const CornerNumber at_a = 3 * face + i, at_b = 3 * face + j;
        sides.push_back(a < b ? Side{a, b, at_a, at_b, true} : Side{b, a, at_b, at_a, false});
      }
    std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
      return std::tie(x.low, x.high, x.at_low) < std::tie(y.low, y.high, y.at_low);
    });
    return sides;
  }

  void join_over_smooth_edges() {
    const std::vector<Side> all = sides();
    for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
      while (end < all.size() && all[end].low == all[begin].low && all[end].high == all[begin].high)
        ++end;
      if (end - begin == 2) join_if_smooth(all[begin], all[begin + 1]);
    }
  }

  void join_if_smooth(const Side& a, const Side& b) {
    const std::uint32_t one = a.at_low / 3, other = b.at_low / 3;
    const Vec3d n = face_normals_[one], m = face_normals_[other];
    if (a.upwards == b.upwards || dot(n, m) < least_cosine_) return;
    sets_.join(a.at_low, b.at_low);
    sets_.join(a.at_high, b.at_high);
    is_smooth_[one] = is_smooth_[other] = true;
  }

  [[nodiscard]] double angle_at(std::uint32_t face, std::size_t corner) const {
    const Vec3d at = place(face, corner);
    const Vec3d a = place(face, (corner + 1) % 3) - at, b = place(face, (corner + 2) % 3) - at;
    return std::atan2(length(cross(a, b)), dot(a, b));
  }

  /// One for each set of a smooth triangle's corners; the first is zero, for the flat ones.
  void add_normals() {
    std::vector<std::uint32_t> index_of(3 * mesh_.corners.size(), 0);
    mesh_.normals.assign(1, Vec3d{});
    for (std::uint32_t face = 0; face < mesh_.corners.size(); ++face)
      for (std::uint32_t i = 0; i < 3; ++i) {
        mesh_.corners[face][i].normal = 0;
        if (!is_smooth_[face]) continue;
        std::uint32_t& index = index_of[sets_.first_of(3 * face + i)];
        if (index == 0) {
          index = static_cast<std::uint32_t>(mesh_.normals.size());
          mesh_.normals.emplace_back();
        }
        mesh_.normals[index] += face_normals_[face] * angle_at(face, i);
        mesh_.corners[face][i].normal = index;
      }
    for (Vec3d& normal : mesh_.normals) normal = unit_or_zero(normal);
  }

  Triangles& mesh_;
  double least_cosine_;
  CornerSets sets_;
  std::vector<bool> is_smooth_;
  std::vector<Vec3d> face_normals_;
};

}  // namespace

void smooth_normals(Triangles& mesh, double crease) {
  if (mesh.normals.empty()) Smoother(mesh, crease).run();
}

}  // namespace portalens
