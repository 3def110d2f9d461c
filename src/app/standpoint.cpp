#include "app/standpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/error.h"

namespace portalens {
namespace {

constexpr double margin = 1.12;          ///< room round what is drawn
constexpr double largest_surface = 2.5;  ///< a surface this much larger than all else is cut off
constexpr double widest = 120.0;         ///< field of view that is chosen at most, degrees

/// What is sure to matter: where photons begin and end or do something, portals, horizons.
Box core_box(const World& world, const std::vector<DrawnPath>& paths) {
  Box box;
  const auto add = [&box](Vec3d place) {
    if (is_finite(place)) box.add(place);
  };
  for (const DrawnPath& path : paths) {
    const auto& stretches = path.trace.path_trace.stretches;
    for (const std::vector<Vec3d>& stretch : stretches)
      if (!stretch.empty()) add(stretch.front());
    for (std::size_t i = 0; i + 1 < stretches.size(); ++i)
      if (!stretches[i].empty()) add(stretches[i].back());
    for (const Arrival& bounce : path.trace.bounces) add(bounce.position);
    if (path.trace.end.met != Met::nothing) add(path.trace.end.position);
  }
  for (const Portal& portal : world.space.portals.portals())
    for (const Vec3d& vertex : portal.vertices) add(vertex);
  for (const Mass& mass : world.space.masses) {
    const double radius = mass.horizon ? mass.horizon_radius : 0.0;
    const Vec3d reach{radius, radius, radius};
    add(mass.center - reach);
    add(mass.center + reach);
  }
  return box;
}

struct Axes {
  Vec3d right, up;
};

Axes axes_of(Standpoint from) {
  switch (from) {
    case Standpoint::top:
      return {{1, 0, 0}, {0, 0, -1}};
    case Standpoint::side:
      return {{0, 0, -1}, {0, 1, 0}};
    default:
      return {{1, 0, 0}, {0, 1, 0}};
  }
}

/// What is shown along an axis, in the direction of the axis.
struct Range {
  double low, high;
};
Range range_along(const Box& box, Vec3d axis) {
  const double a = dot(box.low, axis), b = dot(box.high, axis);
  return {std::min(a, b), std::max(a, b)};
}

Camera plan(const StandpointChoice& choice, const Box& box, double aspect) {
  const Axes axes = axes_of(choice.from);
  Range across = range_along(box, axes.right), above = range_along(box, axes.up);
  double room = margin;
  if (choice.extent) {
    const auto& [x0, y0, x1, y1] = *choice.extent;
    const bool turned_x = choice.from == Standpoint::side,
               turned_y = choice.from == Standpoint::top;
    across = turned_x ? Range{-x1, -x0} : Range{x0, x1};
    above = turned_y ? Range{-y1, -y0} : Range{y0, y1};
    room = 1.0;
  }
  Camera camera;
  camera.projection = Projection::orthographic;
  camera.right = axes.right;
  camera.up = axes.up;
  camera.forward = cross(axes.up, axes.right);
  camera.position =
      axes.right * (0.5 * (across.low + across.high)) + axes.up * (0.5 * (above.low + above.high));
  camera.size = room * std::max(above.high - above.low, (across.high - across.low) / aspect);
  return camera;
}

/// Half the height of a view at depth 1 that shows all of the box.
double fitting_slope(const Camera& camera, const Box& box, double aspect) {
  double slope = 0.0;
  for (unsigned i = 0; i < 8; ++i) {
    const Vec3d corner{i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y,
                       i & 4 ? box.high.z : box.low.z};
    const Vec3d way = corner - camera.position;
    const double depth = dot(way, camera.forward);
    if (depth <= 0.0) return std::numeric_limits<double>::infinity();
    slope = std::max({slope, std::fabs(dot(way, camera.up)) / depth,
                      std::fabs(dot(way, camera.right)) / depth / aspect});
  }
  return slope;
}

Camera placed(const StandpointChoice& choice, const Box& box, double aspect) {
  Camera camera;
  camera.position = *choice.eye;
  const Vec3d way = choice.look_at.value_or(box.middle()) - camera.position;
  const double distance = length(way);
  if (!(distance > 1e-9 * (1.0 + length(camera.position))))
    refuse("--eye and --look-at are the same place", "move one of the two, or leave --look-at out");
  camera.forward = way / distance;
  const bool steep = std::fabs(camera.forward.y) > 0.999;
  camera.right = normalize(cross(camera.forward, steep ? Vec3d{0, 0, -1} : Vec3d{0, 1, 0}));
  camera.up = cross(camera.right, camera.forward);
  const double fitting =
      2.0 * std::atan(1.05 * fitting_slope(camera, box, aspect)) * 180.0 / std::numbers::pi;
  camera.fov = choice.fov.value_or(std::clamp(fitting, 1e-3, widest));
  camera.fov_axis = FovAxis::y;
  return camera;
}

}  // namespace

Box box_of_interest(const World& world, const std::vector<DrawnPath>& paths) {
  const Box core = core_box(world, paths);
  const double size = core.diagonal();
  Box box = core;
  for (const DrawnPath& path : paths)
    for (const std::vector<Vec3d>& stretch : path.trace.path_trace.stretches)
      for (const Vec3d& point : stretch)
        if (is_finite(point) && (size == 0.0 || core.distance(point) <= 0.5 * size)) box.add(point);
  const double most = box.diagonal() > 0.0 ? largest_surface * box.diagonal()
                                           : std::numeric_limits<double>::infinity();
  Box whole = box;
  for (const Shape& shape : world.space.surfaces.shapes()) {
    const Box bounds = std::visit([](const auto& one) { return one.bounds(); }, shape);
    Box both = box;
    both.add(bounds);
    if (!bounds.empty() && both.diagonal() <= most) whole.add(bounds);
  }
  if (whole.empty()) whole.add(world.camera.position);
  return whole.diagonal() > 0.0 ? whole : whole.grown(1.0);
}

Camera drawing_camera(const World& world, const StandpointChoice& choice, const Box& interest,
                      double aspect) {
  if (choice.from != Standpoint::camera) return plan(choice, interest, aspect);
  return choice.eye ? placed(choice, interest, aspect) : world.camera;
}

std::string standpoint_text(const StandpointChoice& choice) {
  switch (choice.from) {
    case Standpoint::top:
      return "seen from above: x to the right, z downwards";
    case Standpoint::front:
      return "seen from the front: x to the right, y upwards";
    case Standpoint::side:
      return "seen from the right: z to the left, y upwards";
    case Standpoint::camera:
      break;
  }
  if (!choice.eye) return "seen by its camera";
  return fmt::format("seen from ({:.4g}, {:.4g}, {:.4g})", choice.eye->x, choice.eye->y,
                     choice.eye->z);
}

}  // namespace portalens
