#include "world/portal_overlap.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace portalens {
namespace {

/// Relative to the longer of the longest edges.
constexpr double same = 1e-6;

/// Whether an edge of `a` has all of `b` on its outer side: then they are apart. For convex
/// polygons one of the two always has such an edge if they are.
bool an_edge_separates(const Portal& a, const Portal& b, double tolerance) {
  const std::size_t count = a.vertices.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d edge = normalize(a.vertices[(i + 1) % count] - a.vertices[i]);
    const Vec3d inward = cross(a.frame.normal, edge);
    double deepest = -std::numeric_limits<double>::infinity();
    for (const Vec3d& vertex : b.vertices)
      deepest = std::max(deepest, dot(vertex - a.vertices[i], inward));
    if (deepest <= tolerance) return true;
  }
  return false;
}

}  // namespace

bool portals_overlap(const Portal& a, const Portal& b) {
  const double tolerance = same * std::max(a.longest_edge, b.longest_edge);
  if (dot(a.frame.normal, b.frame.normal) < 1.0 - same * same) return false;
  if (std::fabs(dot(b.frame.origin - a.frame.origin, a.frame.normal)) > tolerance) return false;
  return !an_edge_separates(a, b, tolerance) && !an_edge_separates(b, a, tolerance);
}

}  // namespace portalens
