#include "world/polygon_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/extent.h"
#include "portal/portal.h"

namespace portalens {
namespace {

/// All relative to the longest edge.
constexpr double coincident = 1e-9;
constexpr double planar = 1e-6;
constexpr double convex = 1e-9;

Vec3d doubled_area(const std::vector<Vec3d>& vertices) {
  Vec3d sum;
  for (std::size_t i = 2; i < vertices.size(); ++i)
    sum += cross(vertices[i - 1] - vertices[0], vertices[i] - vertices[0]);
  return sum;
}

/// The first vertex found on the wrong side of an edge.
std::optional<std::size_t> reentrant(const std::vector<Vec3d>& vertices, const Frame& frame,
                                     double longest) {
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec3d& from = vertices[i];
    const Vec3d edge = normalize(vertices[(i + 1) % vertices.size()] - from);
    const Vec3d inward = cross(frame.normal, edge);
    for (std::size_t j = 0; j < vertices.size(); ++j)
      if (dot(vertices[j] - from, inward) < -convex * longest) return j;
  }
  return std::nullopt;
}

}  // namespace

double longest_edge(const std::vector<Vec3d>& vertices) {
  double longest = 0.0;
  for (std::size_t i = 0; i < vertices.size(); ++i)
    longest = std::max(longest, length(vertices[(i + 1) % vertices.size()] - vertices[i]));
  return longest;
}

std::string written(const std::vector<Vec3d>& vertices) {
  std::string text;
  for (const Vec3d& v : vertices)
    text += fmt::format("{}[{:.6g}, {:.6g}, {:.6g}]", text.empty() ? "" : " ", v.x, v.y, v.z);
  return text;
}

std::optional<PolygonFault> polygon_fault(const std::vector<Vec3d>& vertices) {
  for (const Vec3d& v : vertices)
    if (!(std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}) <= largest_coordinate))
      return PolygonFault{"vertices lie farther than 1e12 from the origin", "move them nearer"};
  const double longest = longest_edge(vertices);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (length(vertices[i] - vertices[j]) <= coincident * longest)
        return PolygonFault{fmt::format("vertices {} and {} coincide", j, i),
                            "name each corner once"};
  if (!(length(doubled_area(vertices)) > coincident * longest * longest))
    return PolygonFault{"vertices lie on one line", "give the corners of a polygon with an area"};
  const Frame frame = polygon_frame(vertices);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const double height = std::fabs(dot(vertices[i] - frame.origin, frame.normal));
    if (height > planar * longest)
      return PolygonFault{
          fmt::format("vertices are not in one plane: vertex {} is off by {:.3g}", i, height),
          "move them into one plane, to 1e-6 of the longest edge"};
  }
  if (const auto wrong = reentrant(vertices, frame, longest))
    return PolygonFault{
        fmt::format("vertices do not form a convex polygon (see vertex {})", *wrong),
        "list the corners of a convex polygon in order, counter-clockwise seen "
        "from the front"};
  return std::nullopt;
}

}  // namespace portalens
