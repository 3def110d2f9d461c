#include "render/cut_turning.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace portalens {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// A straight piece of a path.
struct Piece {
  Vec3d from, direction;
  double length;
};

/// ∫ ds / (s² + b²)^(3/2) times b² from `begin` to `end`, which may be infinite.
double along(double begin, double end, double b2) {
  const auto until = [&](double s) {
    return std::isinf(s) ? std::copysign(1.0, s) : s / std::sqrt(s * s + b2);
  };
  return until(end) - until(begin);
}

/// What the mass would add to the direction along the piece, where that lies beyond its influence.
Vec3d cut_pull(const Mass& mass, double m, const Piece& piece) {
  const Vec3d to = mass.center - piece.from;
  const double nearest = dot(to, piece.direction);  // as far along the piece
  const Vec3d across = to - nearest * piece.direction;
  const double b2 = dot(across, across);
  if (b2 == 0.0) return {};
  const double begin = -nearest, end = piece.length - nearest;
  double share = along(begin, end, b2);
  const double half2 = mass.influence * mass.influence - b2;
  if (half2 > 0.0) {
    const double half = std::sqrt(half2);
    const double in = std::max(begin, -half), out = std::min(end, half);
    if (in < out) share -= along(in, out, b2);
  }
  return (m * share / b2) * across;
}

/// The pieces of one stretch; the last of an escaped photon's has no end.
std::vector<Piece> pieces_of(const std::vector<Vec3d>& points) {
  std::vector<Piece> pieces;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Vec3d step = points[i] - points[i - 1];
    if (const double far = length(step); far > 0.0)
      pieces.push_back({points[i - 1], step * (1.0 / far), far});
  }
  return pieces;
}

}  // namespace

std::optional<double> cut_turning(const World& world, const Trace& trace) {
  const Space& space = world.space;
  if (space.masses.size() > max_cut_masses) return std::nullopt;
  double sum = 0.0;
  const auto& stretches = trace.path_trace.stretches;
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    std::vector<Piece> pieces = pieces_of(stretches[i]);
    if (i + 1 == stretches.size() && trace.end.fate == Fate::escaped)
      pieces.push_back({trace.end.position, trace.end.direction, infinite});
    Vec3d turned;
    for (const Mass& mass : space.masses) {
      if (!std::isfinite(mass.influence)) continue;
      const double m = space.medium.far_weight * gravitational_radius(mass.gm, space.physics.c);
      for (const Piece& piece : pieces) turned += cut_pull(mass, m, piece);
    }
    sum += length(turned);
  }
  return sum;
}

}  // namespace portalens
