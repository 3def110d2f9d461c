/// \file
/// Small parts of which the intersections with curved and boxed shapes are made.
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "geometry/ray.h"

namespace portalens {

/// Keeps the nearest contact of a range; at equal distances the first face given.
class NearestContact {
 public:
  NearestContact(double low, double high) : low_(low), high_(high) {}

  void consider(double distance, std::uint32_t face) {
    if (!(distance >= low_ && distance <= high_)) return;
    if (best_ && distance >= best_->distance) return;
    best_ = Contact{distance, face};
  }
  [[nodiscard]] std::optional<Contact> best() const { return best_; }

 private:
  double low_, high_;
  std::optional<Contact> best_;
};

/// A ray in a shape's own coordinates, started where it is closest to their origin: from there the
/// equations of a shape have no large terms. `offset` is the distance from the old start to the
/// new.
struct CenteredRay {
  Vec3d origin, direction;
  double offset = 0.0;
  double rounding = 0.0;  ///< by how much positions may be off

  CenteredRay(Vec3d local_origin, Vec3d local_direction, double rounding_of_positions)
      : direction(local_direction),
        offset(-dot(local_origin, local_direction)),
        rounding(rounding_of_positions) {
    origin = local_origin + direction * offset;
  }
  [[nodiscard]] Vec3d at(double distance) const { return origin + direction * distance; }
};

/// How far off the positions of a ray and a shape may be, by rounding.
///
/// A ray that misses a round surface by no more than that touches it: otherwise light that grazes
/// the inside of a sphere far from the origin would find itself outside after a bounce, and escape.
[[nodiscard]] inline double rounding_at(Vec3d origin, Vec3d middle) {
  const auto size = [](Vec3d p) { return std::fabs(p.x) + std::fabs(p.y) + std::fabs(p.z); };
  return 1e-15 * (size(origin) + size(middle));
}

/// Roots of a t² + 2 b t + c, without cancellation; those that don't exist are not a number or
/// infinite.
/// @param tolerance  b² - a c may be so far below 0, or lost in rounding, for a touch: two equal
///                   roots
[[nodiscard]] inline std::array<double, 2> roots(double a, double b, double c, double tolerance) {
  double square = b * b - a * c;
  if (square < 0.0 && square >= -tolerance - 1e-15 * (b * b + std::fabs(a * c))) square = 0.0;
  const double root = std::sqrt(square);
  const double q = b < 0.0 ? root - b : -root - b;
  return {q / a, c / q};
}

/// Whether `value` is at most `limit`, or above by no more than rounding would make it: pieces of a
/// surface that meet at an edge overlap by 1e-12 of its size.
[[nodiscard]] inline bool within(double value, double limit, double size) {
  return value <= limit + 1e-12 * size;
}

/// u of a shape that is round about y: 1/2 + atan2(x, z) / 2π, as a share of the way round.
[[nodiscard]] double u_around(Vec3d local);
/// A cap's picture: the square around the disc, seen from outside, upright as on a cube.
/// @param side  +1: it faces +y, -1: -y
void put_cap_coordinates(SurfacePoint& point, Vec3d local, double radius, double side);

}  // namespace portalens
