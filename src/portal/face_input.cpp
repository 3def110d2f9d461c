#include "portal/face_input.h"

#include <cmath>

namespace portalens {

PlaneBox box_of(std::span<const Vec3d> corners) {
  PlaneBox box;
  for (const Vec3d& corner : corners) {
    box.low_x = std::min(box.low_x, corner.x);
    box.low_y = std::min(box.low_y, corner.y);
    box.high_x = std::max(box.high_x, corner.x);
    box.high_y = std::max(box.high_y, corner.y);
  }
  return box;
}

double area_of(std::span<const Vec3d> corners) {
  Vec3d twice;
  for (std::size_t i = 0; i < corners.size(); ++i)
    twice += cross(corners[i], corners[(i + 1) % corners.size()]);
  return 0.5 * length(twice);
}

double longest_of(std::span<const PlaneEdge> edges) {
  double longest = 0.0;
  for (const PlaneEdge& edge : edges) longest = std::max(longest, edge.length);
  return longest;
}

double mismatch_of(std::span<const Vec3d> corners, std::span<const Vec3d> pair) {
  const std::size_t count = corners.size();
  if (count != pair.size()) return std::numeric_limits<double>::infinity();
  double worst = 0.0, longest = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d turned{-corners[i].x, corners[i].y, -corners[i].z};
    worst = std::max(worst, length(turned - pair[(count + 1 - i) % count]));
    longest = std::max(longest, length(corners[(i + 1) % count] - corners[i]));
  }
  return worst / longest;
}

std::size_t reentrant_corner(std::span<const Vec3d> corners) {
  const std::vector<PlaneEdge> edges = edges_between(corners);
  const double rounding = 1e-9 * longest_of(edges);
  for (const PlaneEdge& edge : edges)
    for (std::size_t j = 0; j < corners.size(); ++j)
      if (edge.outside(corners[j].x, corners[j].y) > rounding) return j;
  return corners.size();
}

}  // namespace portalens
