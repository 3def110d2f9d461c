#include "gravity/graviton_map_coupling.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gravity/decision_hash.h"

namespace portalens {

namespace {

/// Nodes across a side so that their spacing is at most `spacing`.
std::uint32_t nodes_across(double side, double spacing) {
  const double cells = std::ceil(side / spacing * (1.0 - 1e-9));
  return static_cast<std::uint32_t>(std::max(1.0, cells)) + 1;
}

std::uint32_t cell_of(double offset, double spacing, std::uint32_t count) {
  // A point that keeps to a grid line, as in a symmetric scene, keeps to one cell.
  const double cell = std::floor(offset / spacing + 1e-9);
  return static_cast<std::uint32_t>(std::clamp(cell, 0.0, static_cast<double>(count - 2)));
}

}  // namespace

GravitonMapCoupling::GravitonMapCoupling(const CouplingInput& input) : exact_(input) {
  for (std::uint32_t a = 0; a < exact_.portal_count(); ++a) add_grid(a, input.graviton_resolution);
}

CouplingCost GravitonMapCoupling::cost(const CouplingInput& input) {
  if (input.depth == 0) return {};
  const double nodes = static_cast<double>(input.graviton_resolution) * input.graviton_resolution;
  return {5.0 * static_cast<double>(input.portals.size()),
          nodes * ClosestPointCoupling::cost(input).each_call};
}

void GravitonMapCoupling::add_grid(std::uint32_t portal, int resolution) {
  const PortalFace& face = exact_.face(portal);
  double high_x = -std::numeric_limits<double>::infinity(), high_y = high_x;
  Grid grid;
  grid.low_x = grid.low_y = std::numeric_limits<double>::infinity();
  for (const FaceEdge& edge : face.edges()) {
    grid.low_x = std::min(grid.low_x, edge.start_x);
    grid.low_y = std::min(grid.low_y, edge.start_y);
    high_x = std::max(high_x, edge.start_x);
    high_y = std::max(high_y, edge.start_y);
  }
  const double width = high_x - grid.low_x, height = high_y - grid.low_y;
  const double spacing = std::max(width, height) / (std::max(resolution, 2) - 1);
  grid.count_x = nodes_across(width, spacing);
  grid.count_y = nodes_across(height, spacing);
  grid.spacing_x = width / (grid.count_x - 1);
  grid.spacing_y = height / (grid.count_y - 1);
  grid.first = nodes_.size();
  if (!(exact_.reach(portal) > 0.0)) grid.count_x = grid.count_y = 0;
  for (std::uint32_t j = 0; j < grid.count_y; ++j)
    for (std::uint32_t i = 0; i < grid.count_x; ++i) {
      const Vec3d q = face.frame().to_world(
          {grid.low_x + grid.spacing_x * i, grid.low_y + grid.spacing_y * j, 0.0});
      nodes_.push_back(exact_.passed_on(portal, q, q));
    }
  grids_.push_back(grid);
}

bool GravitonMapCoupling::draws(std::uint32_t portal, Vec3d x, Draw& draw) const {
  const double reach = exact_.reach(portal);
  if (!(reach > 0.0)) return false;
  const PortalFace& face = exact_.face(portal);
  const Vec3d local = face.frame().to_local(x);
  draw.feature = face.nearest(local);
  const Vec3d place = face.place(draw.feature, local);
  const Vec3d apart = local - place;
  if (!(dot(apart, apart) < reach * reach)) return false;
  const Grid& grid = grids_[portal];
  draw.i = cell_of(place.x - grid.low_x, grid.spacing_x, grid.count_x);
  draw.j = cell_of(place.y - grid.low_y, grid.spacing_y, grid.count_y);
  return true;
}

Pull GravitonMapCoupling::interpolate(const Grid& grid, const Draw& draw, Vec3d place) const {
  const double u = (place.x - grid.low_x) / grid.spacing_x - draw.i;
  const double v = (place.y - grid.low_y) / grid.spacing_y - draw.j;
  const Pull &a = node(grid, draw.i, draw.j), &b = node(grid, draw.i + 1, draw.j);
  const Pull &c = node(grid, draw.i, draw.j + 1), &d = node(grid, draw.i + 1, draw.j + 1);
  return {(a.acceleration * (1.0 - u) + b.acceleration * u) * (1.0 - v) +
              (c.acceleration * (1.0 - u) + d.acceleration * u) * v,
          std::max({a.stiffness, b.stiffness, c.stiffness, d.stiffness}),
          std::max({a.nearness, b.nearness, c.nearness, d.nearness})};
}

Pull GravitonMapCoupling::pull(Vec3d x, Vec3d anchor) const {
  Pull total;
  Draw draw;
  for (std::uint32_t a = 0; a < grids_.size(); ++a) {
    if (!draws(a, anchor, draw)) continue;
    const PortalFace& face = exact_.face(a);
    total += interpolate(grids_[a], draw, face.place(draw.feature, face.frame().to_local(x)));
  }
  return total;
}

std::uint64_t GravitonMapCoupling::signature(Vec3d x) const {
  std::uint64_t total = 0;
  Draw draw;
  for (std::uint32_t a = 0; a < grids_.size(); ++a) {
    if (!draws(a, x, draw)) continue;
    const Grid& grid = grids_[a];
    const bool empty = node(grid, draw.i, draw.j).acceleration == Vec3d{} &&
                       node(grid, draw.i + 1, draw.j).acceleration == Vec3d{} &&
                       node(grid, draw.i, draw.j + 1).acceleration == Vec3d{} &&
                       node(grid, draw.i + 1, draw.j + 1).acceleration == Vec3d{};
    if (empty) continue;
    const std::uint64_t way = mix_decision(mix_decision(0, a), draw.feature.code());
    total += mix_decision(mix_decision(way, draw.i), draw.j);
  }
  return total;
}

std::vector<PullPart> GravitonMapCoupling::parts(Vec3d x) const {
  std::vector<PullPart> found;
  Draw draw;
  for (std::uint32_t a = 0; a < grids_.size(); ++a) {
    if (!draws(a, x, draw)) continue;
    const PortalFace& face = exact_.face(a);
    const Vec3d local = face.frame().to_local(x);
    const Vec3d place = face.place(draw.feature, local);
    PullPart part;
    part.portals = {a};
    part.acceleration = interpolate(grids_[a], draw, place).acceleration;
    part.entrance = face.frame().to_world(place);
    part.places = {part.entrance};
    part.beyond = exact_.through(a).move(part.entrance);
    part.distance = length(local - place);
    if (part.acceleration != Vec3d{}) found.push_back(part);
  }
  return found;
}

GravitonMapError GravitonMapCoupling::error(std::uint32_t portal) const {
  const Grid& grid = grids_[portal];
  const PortalFace& face = exact_.face(portal);
  double sum_difference = 0.0, sum_exact = 0.0, most_difference = 0.0, most_exact = 0.0;
  for (std::uint32_t j = 0; j + 1 < grid.count_y; ++j)
    for (std::uint32_t i = 0; i + 1 < grid.count_x; ++i) {
      const Vec3d place{grid.low_x + grid.spacing_x * (i + 0.5),
                        grid.low_y + grid.spacing_y * (j + 0.5), 0.0};
      if (!face.covers(place.x, place.y)) continue;
      const Vec3d q = face.frame().to_world(place);
      const Vec3d exact = exact_.passed_on(portal, q, q).acceleration;
      const Vec3d difference = interpolate(grid, {{}, i, j}, place).acceleration - exact;
      sum_difference += dot(difference, difference);
      sum_exact += dot(exact, exact);
      most_difference = std::max(most_difference, dot(difference, difference));
      most_exact = std::max(most_exact, dot(exact, exact));
    }
  if (!(most_exact > 0.0)) return {};
  return {std::sqrt(sum_difference / sum_exact), std::sqrt(most_difference / most_exact)};
}

}  // namespace portalens
