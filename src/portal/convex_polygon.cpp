#include "portal/convex_polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace portalens {

ConvexPolygon::ConvexPolygon(std::vector<Vec3d> corners)
    : corners_(std::move(corners)), edges_(edges_between(corners_)) {
  const std::size_t count = corners_.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d &from = corners_[(i + count - 1) % count], &to = corners_[i];
    const double dx = to.x - from.x, dy = to.y - from.y;
    sides_.push_back({from.x, from.y, dx, dy, std::sqrt(dx * dx + dy * dy)});
  }
}

std::optional<ConvexPolygon> ConvexPolygon::from(const FaceInput& input) {
  std::vector<Vec3d> corners = input.local_vertices();
  if (corners.empty() || reentrant_corner(corners) < corners.size()) return std::nullopt;
  return ConvexPolygon(std::move(corners));
}

Feature ConvexPolygon::nearest_from_outside(double x, double y) const {
  Feature best;
  double least = std::numeric_limits<double>::infinity();
  const auto count = static_cast<std::uint32_t>(edges_.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    const PlaneEdge& edge = edges_[i];
    const double s = edge.along(x, y);
    const double held = std::clamp(s, 0.0, edge.length);
    const double dx = x - edge.start_x - edge.direction_x * held;
    const double dy = y - edge.start_y - edge.direction_y * held;
    const double square = dx * dx + dy * dy;
    if (square >= least) continue;
    least = square;
    if (s <= 0.0)
      best = {Feature::Kind::vertex, i};
    else if (s >= edge.length)
      best = {Feature::Kind::vertex, (i + 1) % count};
    else
      best = {Feature::Kind::edge, i};
  }
  return best;
}

double ConvexPolygon::distance_to_discontinuity(Vec3d local, double tolerance) const {
  // Beside the polygon's column it moves steadily. Within, it jumps at the plane and, behind that,
  // where another edge becomes the nearest: none of these is nearer than any of the three bounds.
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double first = -infinity, second = -infinity;
  for (const PlaneEdge& edge : edges_) {
    const double outside = edge.outside(local.x, local.y);
    second = std::max(second, std::min(first, outside));
    first = std::max(first, outside);
  }
  const double height = std::fabs(local.z);
  const double within = local.z >= -tolerance ? height : std::min(height, 0.5 * (first - second));
  return std::max(first, within);
}

}  // namespace portalens
