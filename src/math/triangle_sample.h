/// \file
/// Points of triangles, drawn by the solid angle under which they are seen from a place.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "math/vec3.h"

namespace portalens {

using TriangleCorners = std::array<Vec3d, 3>;

[[nodiscard]] double area_of(const TriangleCorners& corners);

/// The solid angle of a triangle as seen from `x`, from either side; 0 in its plane. Van Oosterom
/// & Strackee 1983.
[[nodiscard]] double solid_angle_of(const TriangleCorners& corners, Vec3d x);

/// A point drawn as some `x` sees it. The mean of f `solid_angle` over such points is the integral
/// of f over the solid angle of what they are drawn from.
struct SeenPoint {
  Vec3d position;
  double solid_angle = 0.0;  ///< 1 over the probability per solid angle
  std::size_t triangle = 0;  ///< of several, the one it lies on
};

/// What a point that is one of `area` drawn uniformly by area is, as seen from `x`.
/// @param normal  unit, of either side
[[nodiscard]] SeenPoint seen_by_area(Vec3d position, Vec3d normal, double area, Vec3d x);

/// A point of a triangle, uniform by solid angle as seen from `x`. Arvo, "Stratified Sampling of
/// Spherical Triangles", 1995. Where the triangle is too small in sight for that to be exact, it is
/// drawn by area, which then hardly differs.
/// @param solid_angle  of it
/// @param u1,u2        uniform in [0, 1)
[[nodiscard]] SeenPoint sample_triangle(const TriangleCorners& corners, double solid_angle, Vec3d x,
                                        double u1, double u2);

/// A choice among a few things by weights: what is chosen, its probability, and what is left of the
/// uniform number, which is uniform again.
class FewWeights {
 public:
  static constexpr std::size_t max_count = 32;

  /// @param weight  >= 0
  /// @pre fewer than `max_count` were added
  void add(double weight) {
    total_ += weight;
    up_to_[count_++] = total_;
  }
  [[nodiscard]] double total() const { return total_; }

  struct Choice {
    std::size_t index = 0;
    double probability = 0.0, left = 0.0;
  };
  /// @pre total() > 0
  [[nodiscard]] Choice choose(double u) const;

 private:
  std::array<double, max_count> up_to_{};
  std::size_t count_ = 0;
  double total_ = 0.0;
};

/// A point of the triangles together, uniform by solid angle, whether or not they hide each other.
/// @pre 1 to FewWeights::max_count of them
[[nodiscard]] SeenPoint sample_triangles(std::span<const TriangleCorners> triangles, Vec3d x,
                                         double u1, double u2);

}  // namespace portalens
