#include "math/triangle_sample.h"

#include <algorithm>
#include <cmath>

namespace portalens {
namespace {

/// Below it an angle's square is lost beside 1: the directions of a triangle can't be told apart.
constexpr double least_solid_angle = 1e-8;

/// The unit vector at right angles to `from`, towards `to`.
Vec3d aside(Vec3d from, Vec3d to) { return normalize(to - from * dot(from, to)); }

/// The angle between the planes through `at` and each of the two.
double angle_between(Vec3d at, Vec3d first, Vec3d second) {
  const Vec3d a = cross(at, first), b = cross(at, second);
  return std::atan2(length(cross(a, b)), dot(a, b));
}

/// A unit vector of the spherical triangle a, b, c of that area; no number where its corners or its
/// plane can't be told from each other, as from just above the triangle.
Vec3d direction_within(Vec3d a, Vec3d b, Vec3d c, double area, double u1, double u2) {
  const double alpha = angle_between(a, b, c);
  const double along = dot(a, b);
  // The triangle that shares a, b and the angle at a, and has u1 of the area: q is the cosine of
  // its side from a.
  const double s = std::sin(u1 * area - alpha), t = std::cos(u1 * area - alpha);
  const double u = t - std::cos(alpha), v = s + std::sin(alpha) * along;
  const double q = std::clamp(
      ((v * t - u * s) * std::cos(alpha) - v) / ((v * s + u * t) * std::sin(alpha)), -1.0, 1.0);
  const Vec3d third = a * q + aside(a, c) * std::sqrt(1.0 - q * q);
  const double z = 1.0 - u2 * (1.0 - dot(third, b));
  return normalize(b * z + aside(b, third) * std::sqrt(std::max(0.0, 1.0 - z * z)));
}

}  // namespace

double area_of(const TriangleCorners& corners) {
  return 0.5 * length(cross(corners[1] - corners[0], corners[2] - corners[0]));
}

double solid_angle_of(const TriangleCorners& corners, Vec3d x) {
  const Vec3d a = corners[0] - x, b = corners[1] - x, c = corners[2] - x;
  const double la = length(a), lb = length(b), lc = length(c);
  const double volume = std::fabs(dot(a, cross(b - a, c - a)));
  const double rest = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
  return volume == 0.0 || la * lb * lc == 0.0 ? 0.0 : 2.0 * std::atan2(volume, rest);
}

SeenPoint seen_by_area(Vec3d position, Vec3d normal, double area, Vec3d x) {
  const Vec3d way = position - x;
  const double distance = length(way);
  if (!(distance > 0.0)) return {position};
  const double slope = std::fabs(dot(normal, way)) / distance;
  return {position, area * slope / (distance * distance), 0};
}

SeenPoint sample_triangle(const TriangleCorners& corners, double solid_angle, Vec3d x, double u1,
                          double u2) {
  const Vec3d normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  if (solid_angle < least_solid_angle) {
    const double root = std::sqrt(u1);
    const Vec3d position = corners[0] + (corners[1] - corners[0]) * (root * (1.0 - u2)) +
                           (corners[2] - corners[0]) * (root * u2);
    return seen_by_area(position, normalize(normal), area_of(corners), x);
  }
  const std::array<Vec3d, 3> ways = {corners[0] - x, corners[1] - x, corners[2] - x};
  Vec3d direction = direction_within(normalize(ways[0]), normalize(ways[1]), normalize(ways[2]),
                                     solid_angle, u1, u2);
  if (!is_finite(direction)) direction = normalize(ways[0] + ways[1] + ways[2]);
  const double farthest = std::max({length(ways[0]), length(ways[1]), length(ways[2])});
  const double distance = dot(ways[0], normal) / dot(direction, normal);
  return {x + direction * (distance > 0.0 && distance < farthest ? distance : farthest),
          solid_angle, 0};
}

FewWeights::Choice FewWeights::choose(double u) const {
  const double wanted = u * total_;
  std::size_t index = 0;
  while (index + 1 < count_ && !(wanted < up_to_[index])) ++index;
  while (index > 0 && up_to_[index] == up_to_[index - 1]) --index;  // of those without weight none
  const double before = index == 0 ? 0.0 : up_to_[index - 1], weight = up_to_[index] - before;
  return {index, weight / total_, std::clamp((wanted - before) / weight, 0.0, 1.0)};
}

SeenPoint sample_triangles(std::span<const TriangleCorners> triangles, Vec3d x, double u1,
                           double u2) {
  FewWeights weights;
  for (const TriangleCorners& triangle : triangles) weights.add(solid_angle_of(triangle, x));
  if (!(weights.total() > 0.0)) return {triangles[0][0]};
  const auto [index, probability, left] = weights.choose(u1);
  const SeenPoint point =
      sample_triangle(triangles[index], weights.total() * probability, x, left, u2);
  return {point.position, point.solid_angle / probability, index};
}

}  // namespace portalens
