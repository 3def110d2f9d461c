#include "lanes/isolated_masses.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "photon/space.h"

namespace portalens {
namespace {

/// The shares m/R for which tables are made: those whose errors are tested.
constexpr double least_share = 1e-7, largest_share = 0.4;
/// The errors of tables, in tolerances.
constexpr double angle_share = 0.1, length_share = 1.0;

double share_of(const Space& space, const Mass& mass) {
  return gravitational_radius(mass.gm, space.physics.c) / mass.influence;
}

/// Whether nothing else is or acts within its influence, or closely around it.
bool is_alone(const Space& space, std::uint32_t index, double graze) {
  const Mass& mass = space.masses[index];
  const double radius = mass.influence * (1.0 + 1e-6) + 2.0 * graze;
  const Vec3d center = mass.center;
  // Light that begins within it takes steps, and should take them in lanes.
  if (space.viewpoint && length(*space.viewpoint - center) <= radius) return false;
  if (space.surfaces.clearance(center, 2.0 * radius) <= radius ||
      space.portals.clearance(center, 2.0 * radius) <= radius)
    return false;
  const auto distance_to_support = [&](const auto& coupling) {
    return coupling.distance_to_support(center);
  };
  if (std::visit(distance_to_support, space.coupling) <= radius) return false;
  std::vector<std::uint32_t> near;
  space.mass_tree.around(center, radius, near);
  return std::none_of(near.begin(), near.end(), [&](std::uint32_t i) {
    const Mass& other = space.masses[i];
    return i != index && other.gm > 0.0 &&
           length(other.center - center) <=
               radius + std::fmax(other.influence, other.horizon_radius);
  });
}

}  // namespace

IsolatedMasses isolated_masses(const Space& space, double graze, std::size_t most) {
  const double tolerance = space.physics.tolerance;
  IsolatedMasses isolated;
  // The tables are of the paper's law.
  if (!std::holds_alternative<NewtonLaw>(space.law)) return isolated;
  for (std::uint32_t i = 0; i < space.masses.size() && isolated.masses.size() < most; ++i) {
    const Mass& mass = space.masses[i];
    if (!mass.has_horizon() || mass.core != 0.0 || !std::isfinite(mass.influence)) continue;
    const double share = share_of(space, mass);
    // What grazes an influence by that little is turned by 2 m graze/R².
    if (!(share >= least_share && share <= largest_share) ||
        2.0 * share * graze / mass.influence > angle_share * tolerance ||
        !is_alone(space, i, graze))
      continue;
    const auto same = std::find_if(isolated.tables.begin(), isolated.tables.end(),
                                   [&](const CrossingTable& t) { return t.share() == share; });
    const auto table = static_cast<std::size_t>(same - isolated.tables.begin());
    if (same == isolated.tables.end()) isolated.tables.emplace_back(share);
    if (isolated.tables[table].angle_error() <= angle_share * tolerance &&
        isolated.tables[table].length_error() <= length_share * tolerance)
      isolated.masses.push_back({i, table});
  }
  return isolated;
}

void note_crossing(const Mass& mass, const CrossingTable& table, const State& left, double length,
                   double turning, PathRecord& record) {
  // In the plane of the path: along its last direction, and from there towards the mass.
  const double radius = mass.influence;
  const Vec3d out = left.direction, from = left.position - mass.center;
  const Vec3d aside = out * dot(from, out) - from;
  const double offset = portalens::length(aside);
  const bool captured = dot(from, out) < 0.0;
  const double capture = table.range().capture;
  const double b = captured ? std::fmin(offset / mass.horizon_radius, 1.0) * capture
                            : std::fmin(std::fmax(offset / radius, capture), 1.0);
  const Crossing crossing = table.at(b);
  const Vec3d inwards = offset > 0.0 ? aside / offset : any_perpendicular(out);
  const double begun = length - crossing.length * radius, before = turning - crossing.turning;
  /// The direction and the path to the mass when it still has to turn by `angle`.
  const auto put = [&](double angle, double ahead, double away, double at, double turned) {
    const Vec3d t = out * std::cos(angle) - inwards * std::sin(angle);
    const Vec3d e = out * std::sin(angle) + inwards * std::cos(angle);
    record.pass(mass.center + (t * ahead - e * away) * radius, at, turned);
  };
  // Far from the mass the path is all but straight, and runs up to this far from what is nearest.
  const double half = std::sqrt((1.0 - b) * (1.0 + b));
  const double near = std::fmin(half, 4.0 * std::fmax(b, capture));
  const double share = table.share() / std::fmax(b, 1e-3 * capture);
  const double slight = std::fmin(0.5 * crossing.turning,
                                  1.5 * share * (half - near / std::sqrt(near * near + b * b)));
  const double far = (half - near) * radius;
  put(crossing.turning, -half, b, begun, before);
  put(crossing.turning, -near, b, begun + far, before + slight);
  if (!captured) {
    put(0.5 * crossing.turning, 0.0, closest_approach(table.share(), b),
        begun + 0.5 * crossing.length * radius, before + 0.5 * crossing.turning);
    put(0.0, near, b, length - far, turning - slight);
  }
  record.pass(left.position, length, turning);
}

}  // namespace portalens
