#include "app/path_export.h"

#include <algorithm>
#include <cmath>

#include "app/path_marks.h"

namespace portalens {
namespace {

constexpr Rgb blue{0.03, 0.2, 0.9}, orange{0.9, 0.25, 0.02}, black{0.01, 0.01, 0.01};

std::vector<Vec3d> without_repeats(const std::vector<Vec3d>& points) {
  std::vector<Vec3d> result;
  for (const Vec3d& point : points)
    if (is_finite(point) && (result.empty() || point != result.back())) result.push_back(point);
  return result;
}

/// How far an escaped photon is drawn on: the size of what there is to see.
double tail_length(const World& world) {
  Box box = world.space.surfaces.bounds();
  for (const Portal& portal : world.space.portals.portals())
    for (const Vec3d& vertex : portal.vertices) box.add(vertex);
  for (const Mass& mass : world.space.masses) box.add(mass.center);
  box.add(world.camera.position);
  return 0.5 * box.diagonal();
}

/// Angle between the pieces before and after a point, over half their length; 0 at the ends.
double curvature(const std::vector<Vec3d>& points, std::size_t i) {
  if (i == 0 || i + 1 >= points.size()) return 0.0;
  const Vec3d before = points[i] - points[i - 1], after = points[i + 1] - points[i];
  const double angle = std::atan2(length(cross(before, after)), dot(before, after));
  return angle / (0.5 * (length(before) + length(after)));
}

}  // namespace

Rgb turning_color(double share) {
  const Rgb cold{0.03, 0.1, 0.8}, pale{0.4, 0.4, 0.4}, hot{0.8, 0.03, 0.01};
  const double t = std::clamp(share, 0.0, 1.0);
  return t < 0.5 ? cold + (pale - cold) * (2.0 * t) : pale + (hot - pale) * (2.0 * t - 1.0);
}

void PathExport::add(const Trace& trace) {
  const Rgb color = linear_from_color(fate_ink(trace.end.fate));
  for (std::size_t s = 0; s < trace.path_trace.stretches.size(); ++s) {
    PathLine line;
    line.photon = photons_;
    line.stretch = s;
    line.points = without_repeats(trace.path_trace.stretches[s]);
    if (line.points.empty()) continue;
    line.colors.assign(line.points.size(), color);
    if (s + 1 == trace.path_trace.stretches.size() && trace.end.fate == Fate::escaped)
      line.tail = trace.end.direction * tail_length(world_);
    picture_.lines.push_back(std::move(line));
  }
  ++photons_;
}

void PathExport::color_by_turning() {
  double most = 0.0;
  for (const PathLine& line : picture_.lines)
    for (std::size_t i = 0; i < line.points.size(); ++i)
      most = std::max(most, curvature(line.points, i));
  for (PathLine& line : picture_.lines)
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      const double here = curvature(line.points, i);
      line.colors[i] = turning_color(here > 0.0 ? 1.0 + std::log10(here / most) / 3.0 : 0.0);
    }
}

PathPicture PathExport::release() && {
  if (color_ == PathColor::turning) color_by_turning();
  const std::span<const Portal> portals = world_.space.portals.portals();
  for (std::size_t i = 0; i < portals.size(); ++i)
    picture_.flats.push_back(
        {portals[i].name, portals[i].vertices, i <= portals[i].pair ? blue : orange});
  for (const Mass& mass : world_.space.masses) {
    const double radius = mass.horizon ? mass.horizon_radius : mass.core;
    if (radius > 0.0) picture_.balls.push_back({mass.name, mass.center, radius, black});
  }
  return std::move(picture_);
}

}  // namespace portalens
