#include "gravity/graviton_map_coupling.h"

#include <algorithm>
#include <cmath>

#include "gravity/decision_hash.h"

namespace portalens {

namespace {

/// How much of the tolerance the kinks of cells that are not sharp may take if none of them makes
/// good for another. They mostly do; but what is left is magnified by whatever the path meets next.
constexpr double kink_share = 1.0;

}  // namespace

GravitonMapCoupling::GravitonMapCoupling(const CouplingInput& input) : exact_(input) {
  for (std::uint32_t a = 0; a < exact_.portal_count(); ++a) grids_.push_back(grid_on(a, input));
}

CouplingCost GravitonMapCoupling::cost(const CouplingInput& input) {
  if (input.depth == 0) return {};
  const double nodes = static_cast<double>(input.graviton_resolution) * input.graviton_resolution;
  return {5.0 * static_cast<double>(input.portals.size()),
          nodes * ClosestPointCoupling::cost(input).each_call};
}

GravitonGrid GravitonMapCoupling::grid_on(std::uint32_t portal, const CouplingInput& input) const {
  const PortalFace& face = exact_.face(portal);
  const PlaneBox box = box_of(face.aperture());
  GravitonGrid grid(box.low_x, box.low_y, box.high_x, box.high_y, input.graviton_resolution);
  const double reach = exact_.reach(portal);
  if (!(reach > 0.0)) return grid;
  const auto passed_on = [&](Vec3d place) {
    const Vec3d q = face.frame().to_world(place);
    return exact_.passed_on(portal, q, q);
  };
  grid.fill(passed_on, kink_share * input.unfelt / (2.0 * reach));
  return grid;
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
  draw.cell = grids_[portal].cell_at(place);
  draw.kind = grids_[portal].kind(draw.cell);
  return true;
}

Pull GravitonMapCoupling::pull(Vec3d x, Vec3d anchor) const {
  Pull total;
  Draw draw;
  for (std::uint32_t a = 0; a < grids_.size(); ++a) {
    // Where nothing is drawn no feature is decided: its place on the grid would mean nothing.
    if (!draws(a, anchor, draw) || draw.kind == GravitonGrid::Kind::empty) continue;
    const PortalFace& face = exact_.face(a);
    const Vec3d local = face.frame().to_local(x);
    const Feature now = x == anchor ? draw.feature : face.follow(draw.feature, local);
    const Vec3d place = face.place(now, local);
    const bool frozen = draw.kind == GravitonGrid::Kind::sharp;
    Pull through = grids_[a].interpolate(frozen ? draw.cell : grids_[a].cell_at(place), place);
    through.lead(face.pace(now, local));
    total += through;
  }
  return total;
}

std::uint64_t GravitonMapCoupling::signature(Vec3d x) const {
  std::uint64_t total = 0;
  Draw draw;
  for (std::uint32_t a = 0; a < grids_.size(); ++a) {
    if (!draws(a, x, draw) || draw.kind == GravitonGrid::Kind::empty) continue;
    std::uint64_t way = mix_decision(mix_decision(0, a), draw.feature.code());
    if (draw.kind == GravitonGrid::Kind::sharp)
      way = mix_decision(mix_decision(way, draw.cell.i), draw.cell.j);
    total += way;
  }
  return total;
}

double GravitonMapCoupling::distance_to_discontinuity(Vec3d x) const {
  double least = exact_.distance_to_discontinuity(x);
  Draw draw;
  for (std::uint32_t a = 0; a < grids_.size(); ++a) {
    if (!draws(a, x, draw)) continue;
    const PortalFace& face = exact_.face(a);
    const Vec3d place = face.place(draw.feature, face.frame().to_local(x));
    least = std::min(least, grids_[a].distance_to_discontinuity(draw.cell, place));
  }
  return least;
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
    part.acceleration = grids_[a].interpolate(draw.cell, place).acceleration;
    part.entrance = face.frame().to_world(place);
    part.places = {part.entrance};
    part.beyond = exact_.through(a).move(part.entrance);
    part.distance = length(local - place);
    if (part.acceleration != Vec3d{}) found.push_back(part);
  }
  return found;
}

GravitonMapError GravitonMapCoupling::error(std::uint32_t portal) const {
  if (!(exact_.reach(portal) > 0.0)) return {};
  const GravitonGrid& grid = grids_[portal];
  const PortalFace& face = exact_.face(portal);
  double sum_difference = 0.0, sum_exact = 0.0, max_difference = 0.0, max_exact = 0.0;
  for (std::uint32_t j = 0; j + 1 < grid.count_y(); ++j)
    for (std::uint32_t i = 0; i + 1 < grid.count_x(); ++i) {
      const Vec3d place = grid.place(i + 0.5, j + 0.5);
      if (!face.covers(place.x, place.y)) continue;
      const Vec3d q = face.frame().to_world(place);
      const Vec3d exact = exact_.passed_on(portal, q, q).acceleration;
      const Vec3d difference = grid.interpolate({i, j}, place).acceleration - exact;
      sum_difference += dot(difference, difference);
      sum_exact += dot(exact, exact);
      max_difference = std::max(max_difference, dot(difference, difference));
      max_exact = std::max(max_exact, dot(exact, exact));
    }
  if (!(max_exact > 0.0)) return {};
  return {std::sqrt(sum_difference / sum_exact), std::sqrt(max_difference / max_exact)};
}

}  // namespace portalens
