#include "geometry/flush_face.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace portalens {
namespace {

/// Tiles overlap by no more than that share.
constexpr double edge_rounding = 1e-12;
/// Sizes that differ by no more than this share are the same.
constexpr double same_size = 1e-9;

bool lies_in_plane(const FlushFace& face, const FlushFace& other, double tolerance) {
  return std::all_of(face.hull.begin(), face.hull.end(), [&](const Vec3d& vertex) {
    return std::fabs(dot(vertex - other.hull[0], other.normal)) <= tolerance;
  });
}

/// Whether both polygons lie on one side each of a line along an edge of `a`, but for the
/// tolerance.
bool an_edge_separates(const std::vector<Vec3d>& a, Vec3d normal, const std::vector<Vec3d>& b,
                       double tolerance) {
  const auto extent_along = [](const std::vector<Vec3d>& polygon, Vec3d axis) {
    std::pair<double, double> range{dot(polygon[0], axis), dot(polygon[0], axis)};
    for (const Vec3d& vertex : polygon) {
      const double at = dot(vertex, axis);
      range = {std::min(range.first, at), std::max(range.second, at)};
    }
    return range;
  };
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec3d edge = a[(i + 1) % a.size()] - a[i];
    if (!(length(edge) > 0.0)) continue;
    const Vec3d axis = cross(normal, normalize(edge));
    const auto [a_low, a_high] = extent_along(a, axis);
    const auto [b_low, b_high] = extent_along(b, axis);
    if (std::min(a_high, b_high) - std::max(a_low, b_low) <= tolerance) return true;
  }
  return false;
}

}  // namespace

bool in_one_plane(const FlushFace& a, const FlushFace& b) {
  const double tolerance = tolerance_of(a, b);
  return a.box.diagonal() <= b.box.diagonal() ? lies_in_plane(a, b, tolerance)
                                              : lies_in_plane(b, a, tolerance);
}

bool share_area(const FlushFace& a, const FlushFace& b) {
  const double tolerance = 4.0 * (edge_rounding / same_plane) * tolerance_of(a, b);
  const std::span<const std::vector<Vec3d>> as =
      a.pieces.empty() ? std::span(&a.hull, 1) : std::span(a.pieces);
  const std::span<const std::vector<Vec3d>> bs =
      b.pieces.empty() ? std::span(&b.hull, 1) : std::span(b.pieces);
  return std::any_of(as.begin(), as.end(), [&](const std::vector<Vec3d>& one) {
    return std::any_of(bs.begin(), bs.end(), [&](const std::vector<Vec3d>& other) {
      return !an_edge_separates(one, a.normal, other, tolerance) &&
             !an_edge_separates(other, b.normal, one, tolerance);
    });
  });
}

bool comes_before(const FlushFace& a, const FlushFace& b) {
  if (a.opening != b.opening) return a.opening;
  if (a.opening) return a.id < b.id;
  const bool one_mesh = a.id.object == b.id.object;
  if (!one_mesh && std::fabs(a.extent - b.extent) > same_size * std::max(a.extent, b.extent))
    return a.extent < b.extent;
  return a.id > b.id;
}

}  // namespace portalens
