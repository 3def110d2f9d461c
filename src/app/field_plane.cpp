#include "app/field_plane.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "core/error.h"

namespace portalens {
namespace {

const FieldPlane& checked(const FieldPlane& plane, const char* option) {
  const double width = length(plane.right), height = length(plane.up);
  const bool sound = is_finite(plane.corner) && std::isfinite(width) && std::isfinite(height) &&
                     width > 0.0 && height > 0.0 &&
                     std::fabs(dot(plane.right, plane.up)) <= 1e-6 * width * height;
  if (!sound)
    refuse(std::string(option) + " spans no rectangle",
           "two perpendicular sides are needed, finite and longer than 0");
  if (width > 100.0 * height || height > 100.0 * width)
    refuse(std::string(option) + " spans too narrow a rectangle",
           "let its longer side be at most 100 times the other");
  return plane;
}

/// How far around a mass its pull is worth a look, where there is nothing else to go by.
double room_around(const Mass& mass) {
  if (std::isfinite(mass.influence) && mass.influence > 0.0) return 1.1 * mass.influence;
  return mass.horizon_radius > 0.0 ? 20.0 * mass.horizon_radius : 1.0;
}

/// Around masses and portals, with room on all sides.
Box what_matters(const Space& space) {
  Box box;
  for (const Mass& mass : space.masses) box.add(mass.center);
  for (const Portal& portal : space.portals.portals())
    for (const Vec3d& vertex : portal.vertices) box.add(vertex);
  if (box.empty()) box = space.surfaces.bounds();
  if (box.empty()) box.add(Vec3d{});
  if (box.diagonal() > 0.0) return box.grown(0.3 * box.diagonal());
  return box.grown(space.masses.empty() ? 1.0 : room_around(space.masses.front()));
}

/// "x from -4 to 4 to the right", or nothing where a side is not along an axis.
std::string told_side(Vec3d corner, Vec3d side, const char* where) {
  const double from[] = {corner.x, corner.y, corner.z}, along[] = {side.x, side.y, side.z};
  for (int k = 0; k < 3; ++k)
    if (std::fabs(along[k]) == length(side))
      return fmt::format("{} from {:.4g} to {:.4g} {}", "xyz"[k], from[k], from[k] + along[k],
                         where);
  return "";
}

}  // namespace

FieldPlane plane_along(const std::string& axes, std::optional<double> cut,
                       const std::optional<std::array<double, 4>>& range, const Space& space) {
  const std::string letters = "xyz";
  const std::size_t u = axes.empty() ? std::string::npos : letters.find(axes[0]);
  const std::size_t v = axes.size() != 2 ? std::string::npos : letters.find(axes[1]);
  if (u == std::string::npos || v == std::string::npos || u == v)
    refuse("--plane " + axes + " is no plane",
           "two different letters of x, y, z are needed, such as xz");
  const std::size_t w = 3 - u - v;
  const Box box = what_matters(space);
  const double low[] = {box.low.x, box.low.y, box.low.z};
  const double high[] = {box.high.x, box.high.y, box.high.z};
  std::array<double, 4> edges = {low[u], high[u], low[v], high[v]};
  if (range) edges = *range;
  if ((u + 1) % 3 != v) std::swap(edges[2], edges[3]);  // else seen from behind
  double corner[3], right[3] = {0, 0, 0}, up[3] = {0, 0, 0};
  corner[u] = edges[0];
  corner[v] = edges[2];
  corner[w] = cut.value_or(0.5 * (low[w] + high[w]));
  right[u] = edges[1] - edges[0];
  up[v] = edges[3] - edges[2];
  return checked(
      {{corner[0], corner[1], corner[2]}, {right[0], right[1], right[2]}, {up[0], up[1], up[2]}},
      range ? "--range" : "--plane");
}

FieldPlane plane_of(const std::array<double, 9>& n) {
  return checked({{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]}}, "--rectangle");
}

std::string told(const FieldPlane& plane) {
  const std::string right = told_side(plane.corner, plane.right, "to the right");
  const std::string up = told_side(plane.corner, plane.up, "upwards");
  if (right.empty() || up.empty())
    return fmt::format("{:.4g} x {:.4g}, lower left corner ({:.4g}, {:.4g}, {:.4g})",
                       length(plane.right), length(plane.up), plane.corner.x, plane.corner.y,
                       plane.corner.z);
  const double at[] = {plane.corner.x, plane.corner.y, plane.corner.z};
  const int cut = ('x' + 'y' + 'z') - right[0] - up[0] - 'x';
  return fmt::format("{}, {}; at {} = {:.4g}", right, up, "xyz"[cut], at[cut]);
}

}  // namespace portalens
