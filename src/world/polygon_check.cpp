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

Vec3d doubled_area(const std::vector<Vec3d>& vertices) {
  Vec3d sum;
  for (std::size_t i = 2; i < vertices.size(); ++i)
    sum += cross(vertices[i - 1] - vertices[0], vertices[i] - vertices[0]);
  return sum;
}

constexpr const char* in_order_around =
    "list the corners in order around the polygon, counter-clockwise seen from the front, so that "
    "no edge crosses or touches another";

/// Whether no corner lies beside the line through the first and the one farthest from it.
bool on_one_line(const std::vector<Vec3d>& vertices, double longest) {
  Vec3d farthest;
  for (const Vec3d& v : vertices)
    if (length(v - vertices[0]) > length(farthest)) farthest = v - vertices[0];
  return std::all_of(vertices.begin(), vertices.end(), [&](Vec3d v) {
    return length(cross(v - vertices[0], farthest)) <= coincident * longest * length(farthest);
  });
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
  if (!(length(doubled_area(vertices)) > coincident * longest * longest)) {
    if (on_one_line(vertices, longest))
      return PolygonFault{"vertices lie on one line", "give the corners of a polygon with an area"};
    return PolygonFault{"vertices do not form a simple polygon: its edges cross", in_order_around};
  }
  const Frame frame = polygon_frame(vertices);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const double height = std::fabs(dot(vertices[i] - frame.origin, frame.normal));
    if (height > planar * longest)
      return PolygonFault{
          fmt::format("vertices are not in one plane: vertex {} is off by {:.3g}", i, height),
          "move them into one plane, to 1e-6 of the longest edge"};
  }
  const std::vector<Vec3d> corners = polygon_input(vertices).local_vertices();
  if (reentrant_corner(corners) == corners.size()) return std::nullopt;
  if (const auto met = edges_that_meet(corners)) {
    const auto next = [&](std::size_t i) { return (i + 1) % vertices.size(); };
    return PolygonFault{
        fmt::format("vertices do not form a simple polygon: the edge from vertex {} to {} meets "
                    "that from {} to {}",
                    met->first, next(met->first), met->second, next(met->second)),
        in_order_around};
  }
  return std::nullopt;
}

}  // namespace portalens
