#include "gravity/portal_face.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace portalens {

PortalFace::PortalFace(const Portal& portal)
    : PortalFace(portal.vertices, portal.frame, portal.height_tolerance()) {}

PortalFace::PortalFace(std::vector<Vec3d> vertices, const Frame& frame, double height_tolerance)
    : frame_(frame), vertices_(std::move(vertices)), tolerance_(height_tolerance) {
  edges_.reserve(vertices_.size());
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    const Vec3d a = frame_.to_local(vertices_[i]);
    const Vec3d b = frame_.to_local(vertices_[(i + 1) % vertices_.size()]);
    const double dx = b.x - a.x, dy = b.y - a.y;
    const double size = std::sqrt(dx * dx + dy * dy);
    edges_.push_back({a.x, a.y, dx / size, dy / size, size, frame_.to_world({a.x, a.y, 0.0}),
                      frame_.direction_to_world({dx / size, dy / size, 0.0})});
  }
}

Feature PortalFace::nearest(Vec3d local) const {
  // Inside the outline the nearest rim point is the foot on the nearest edge line; several may be
  // equally near there. Outside of it the nearest point is unique, and the same from both sides.
  std::uint32_t best = 0;
  double least_inside = -std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < edges_.size(); ++i) {
    const double outside = edges_[i].outside(local.x, local.y);
    if (outside > 0.0) return nearest_from_outside(local.x, local.y);
    if (outside > least_inside + tolerance_) {
      least_inside = outside;
      best = i;
    }
  }
  if (local.z >= -tolerance_) return {Feature::Kind::face, 0};
  return {Feature::Kind::edge, best};
}

Feature PortalFace::nearest_from_outside(double x, double y) const {
  Feature best;
  double least = std::numeric_limits<double>::infinity();
  const auto count = static_cast<std::uint32_t>(edges_.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    const FaceEdge& edge = edges_[i];
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

double PortalFace::distance_to_discontinuity(Vec3d local) const {
  // Beside the polygon's column it moves steadily. Within, it jumps at the plane and, behind that,
  // where another edge becomes the nearest: none of these is nearer than any of the three bounds.
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double first = -infinity, second = -infinity;
  for (const FaceEdge& edge : edges_) {
    const double outside = edge.outside(local.x, local.y);
    second = std::max(second, std::min(first, outside));
    first = std::max(first, outside);
  }
  const double height = std::fabs(local.z);
  const double within = local.z >= -tolerance_ ? height : std::min(height, 0.5 * (first - second));
  return std::max(first, within);
}

double PortalFace::distance(Vec3d x) const {
  Vec3d local = frame_.to_local(x);
  const double height = local.z;
  local.z = 0.0;
  const Vec3d nearest_place = place(nearest(local), local);
  local.z = height;
  return length(local - nearest_place);
}

}  // namespace portalens
