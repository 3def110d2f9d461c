#include "gravity/closest_point_coupling.h"

#include <algorithm>
#include <limits>

#include "gravity/attraction.h"
#include "gravity/decision_hash.h"

namespace portalens {

ClosestPointCoupling::ClosestPointCoupling(const CouplingInput& input) : depth_(input.depth) {
  gates_.reserve(input.portals.size());
  for (const Portal& portal : input.portals)
    gates_.push_back({PortalFace(portal), *portal.motion(), portal.pair});
  for (const Mass& mass : input.masses)
    if (mass.gm > 0.0)
      sources_.push_back(
          {mass.center, mass.gm, mass.core * mass.core, mass.influence * mass.influence});
  compute_reaches();
}

CouplingCost ClosestPointCoupling::cost(const CouplingInput& input) {
  double chains = 0.0;
  for (int size = 1; size <= input.depth; ++size) chains += chain_count(input, size);
  // A closest point costs about as much as five masses.
  return {chains * (5.0 + static_cast<double>(input.masses.size())), 0.0};
}

void ClosestPointCoupling::compute_reaches() {
  const std::size_t count = gates_.size();
  reach_.assign(count * static_cast<std::size_t>(depth_ + 1), 0.0);
  for (int k = 1; k <= depth_; ++k)
    for (std::size_t a = 0; a < count; ++a) {
      const std::uint32_t b = gates_[a].pair;
      double farthest = 0.0;
      for (const Source& source : sources_)
        farthest = std::max(farthest,
                            std::sqrt(source.influence2) - gates_[b].face.distance(source.center));
      for (std::uint32_t c = 0; c < count; ++c)
        if (c != b) farthest = std::max(farthest, reach(c, k - 1));
      reach_[static_cast<std::size_t>(k) * count + a] = farthest;
    }
}

double ClosestPointCoupling::distance_to_support(Vec3d x) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t a = 0; a < gates_.size(); ++a) {
    const double acts_within = reach(a);
    if (acts_within > 0.0)
      least = std::min(least, std::max(0.0, gates_[a].face.distance(x) - acts_within));
  }
  return least;
}

double ClosestPointCoupling::distance_to_discontinuity(Vec3d x, int depth,
                                                       std::uint32_t left_out) const {
  double least = std::numeric_limits<double>::infinity();
  if (depth <= 0) return least;
  for (std::uint32_t a = 0; a < gates_.size(); ++a) {
    const double acts_within = reach(a, depth);
    if (a == left_out || !(acts_within > 0.0)) continue;
    const Gate& gate = gates_[a];
    const Vec3d local = gate.face.frame().to_local(x);
    const Feature feature = gate.face.nearest(local);
    const Vec3d place = gate.face.place(feature, local);
    const double distance = length(local - place);
    least = std::min(least, std::fabs(distance - acts_within));
    if (!(distance < acts_within)) {
      // The rim may be far where the plane is near; past that, the face is there at once.
      if (gate.face.is_behind(local)) least = std::min(least, -local.z);
      continue;
    }
    // Where it does not jump, the nearest point moves no faster than x does.
    least = std::min(least, gate.face.distance_to_discontinuity(local));
    const Vec3d beyond = gate.through.move(gate.face.frame().to_world(place));
    double behind = distance_to_discontinuity(beyond, depth - 1, gate.pair);
    for (const Source& source : sources_)
      behind = std::min(behind,
                        std::fabs(length(source.center - beyond) - std::sqrt(source.influence2)));
    least = std::min(least, std::max(behind, gate.face.still(feature, local)));
  }
  return least;
}

Pull ClosestPointCoupling::direct(Vec3d x, Vec3d anchor) const {
  Pull total;
  // Rounding leads places of the faces no further astray.
  const double at = 1e-3 * gates_.front().face.height_tolerance(), at2 = at * at;
  for (const Source& source : sources_) {
    const Vec3d from_anchor = source.center - anchor;
    if (!(dot(from_anchor, from_anchor) < source.influence2)) continue;
    const Vec3d to_mass = source.center - x;
    const double square = dot(to_mass, to_mass) + source.core2;
    // At a point mass no direction is better than another.
    if (!(square > at2)) continue;
    total.acceleration += attraction(to_mass, source.gm, source.core2);
    const double inverse2 = 1.0 / square;
    total.stiffness += source.gm * inverse2 * inverse2 * std::sqrt(inverse2);
    total.nearness += inverse2 * inverse2;
    total.gradient += 2.0 * source.gm * inverse2 * std::sqrt(inverse2);
    total.potential += source.gm * std::sqrt(inverse2);
  }
  return total;
}

Pull ClosestPointCoupling::passed_on(std::uint32_t portal, Vec3d q, Vec3d q_anchor,
                                     int depth) const {
  const Gate& gate = gates_[portal];
  const Vec3d beyond_anchor = gate.through.move(q_anchor);
  const Vec3d beyond = q == q_anchor ? beyond_anchor : gate.through.move(q);
  Pull total = direct(beyond, beyond_anchor);
  if (depth > 1) total += through_portals(beyond, beyond_anchor, depth - 1, gate.pair);
  total.acceleration = gate.through.rotate_back(total.acceleration);
  return total;
}

Pull ClosestPointCoupling::through_portals(Vec3d x, Vec3d anchor, int depth,
                                           std::uint32_t left_out) const {
  Pull total;
  if (depth <= 0) return total;
  for (std::uint32_t a = 0; a < gates_.size(); ++a) {
    const double acts_within = reach(a, depth);
    if (a == left_out || !(acts_within > 0.0)) continue;
    const PortalFace& face = gates_[a].face;
    const Vec3d local_anchor = face.frame().to_local(anchor);
    const Feature feature = face.nearest(local_anchor);
    const Vec3d place_anchor = face.place(feature, local_anchor);
    const Vec3d apart = local_anchor - place_anchor;
    if (!(dot(apart, apart) < acts_within * acts_within)) continue;
    const Vec3d q_anchor = face.frame().to_world(place_anchor);
    const Vec3d local = x == anchor ? local_anchor : face.frame().to_local(x);
    const Feature now = x == anchor ? feature : face.follow(feature, local);
    const Vec3d q = x == anchor ? q_anchor : face.frame().to_world(face.place(now, local));
    Pull through = passed_on(a, q, q_anchor, depth);
    through.lead(face.pace(now, local));
    total += through;
  }
  return total;
}

std::vector<PullPart> ClosestPointCoupling::parts(Vec3d x) const {
  std::vector<PullPart> found;
  add_parts(x, depth_, no_portal, {}, found);
  return found;
}

void ClosestPointCoupling::add_parts(Vec3d x, int depth, std::uint32_t left_out,
                                     const PullPart& before, std::vector<PullPart>& parts) const {
  if (depth <= 0) return;
  for (std::uint32_t a = 0; a < gates_.size(); ++a) {
    const double acts_within = reach(a, depth);
    if (a == left_out || !(acts_within > 0.0)) continue;
    const PortalFace& face = gates_[a].face;
    const Vec3d local = face.frame().to_local(x);
    const Vec3d place = face.place(face.nearest(local), local);
    const double distance = length(local - place);
    if (!(distance < acts_within)) continue;
    PullPart part = before;
    part.portals.push_back(a);
    part.places.push_back(face.frame().to_world(place));
    part.entrance = part.places.front();
    part.beyond = gates_[a].through.move(part.places.back());
    part.distance += distance;
    part.acceleration = direct(part.beyond, part.beyond).acceleration;
    for (std::size_t i = part.portals.size(); i-- > 0;)
      part.acceleration = gates_[part.portals[i]].through.rotate_back(part.acceleration);
    if (part.acceleration != Vec3d{}) parts.push_back(part);
    add_parts(part.beyond, depth - 1, gates_[a].pair, part, parts);
  }
}

std::uint64_t ClosestPointCoupling::decisions(Vec3d x, int depth, std::uint32_t left_out,
                                              std::uint64_t path) const {
  std::uint64_t total = 0;
  if (depth <= 0) return total;
  for (std::uint32_t a = 0; a < gates_.size(); ++a) {
    const double acts_within = reach(a, depth);
    if (a == left_out || !(acts_within > 0.0)) continue;
    const Gate& gate = gates_[a];
    const Vec3d local = gate.face.frame().to_local(x);
    const Feature feature = gate.face.nearest(local);
    const Vec3d place = gate.face.place(feature, local);
    const Vec3d apart = local - place;
    if (!(dot(apart, apart) < acts_within * acts_within)) continue;
    const Vec3d beyond = gate.through.move(gate.face.frame().to_world(place));
    const std::uint64_t way = mix_decision(mix_decision(path, a), feature.code());
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      const Vec3d to_mass = sources_[i].center - beyond;
      if (dot(to_mass, to_mass) < sources_[i].influence2) total += mix_decision(~way, i);
    }
    total += decisions(beyond, depth - 1, gate.pair, way);
  }
  return total;
}

}  // namespace portalens
