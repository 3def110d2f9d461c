#include "photon/last_pull.h"

#include <cmath>

namespace portalens {
namespace {

/// What the pull of portals does from here to infinity, on a straight path; nothing if that can't
/// be told to a small share of the tolerance.
///
/// All of it points to the portals, and falls off with the square of the length of the paths
/// through them, which exceeds the distance r by less than `size`. So it turns light as the pull of
/// a mass there would: by its part across the path times r/(1 + outward), with a relative error of
/// size/r. That part is at most a share size/r of the pull.
std::optional<Vec3d> kick_through_portals(const Space& space, const State& state, Vec3d pull,
                                          Vec3d gates) {
  const Physics& physics = space.physics;
  const Vec3d from = state.position - gates;
  const double r = length(from), outward = dot(from, state.direction) / r;
  const double size = static_cast<double>(physics.portal_gravity_depth + 1) * space.extent;
  if (!(r > size) || outward < 0.9) return std::nullopt;
  if (length(pull) * size * size / (2.0 * r) > 0.02 * physics.tolerance) return std::nullopt;
  return turning_part(pull, state.direction) * (r / (1.0 + outward));
}

}  // namespace

std::optional<LastPull> last_pull(const Space& space, const State& state,
                                  const Surroundings& surroundings, Vec3d through, Vec3d gates) {
  LastPull rest;
  for (const std::uint32_t i : surroundings.inside) {
    const Mass& mass = space.masses[i];
    if (!std::isinf(mass.influence)) return std::nullopt;
    const Vec3d to_mass = mass.center - state.position;
    const double d = length(to_mass);
    const double outward = -dot(to_mass, state.direction) / d;
    if (outward < 0.9) return std::nullopt;
    const Vec3d across = turning_part(to_mass, state.direction);
    const double b = length(across);
    const double gm = space.medium.far_weight * gravitational_radius(mass.gm, space.physics.c);
    if (b == 0.0) continue;
    // ∫ m b / (b² + s²)^(3/2) ds from here to infinity on the straight path = (m/b) (1 - outward).
    const double turning = gm / d * (b / d) / (1.0 + outward);
    rest.turning += turning;
    rest.closeness += gm / d;
    rest.kick += across * (turning / b);
  }
  if (surroundings.distance_to_support == 0.0) {
    const std::optional<Vec3d> kick = kick_through_portals(space, state, through, gates);
    if (!kick) return std::nullopt;
    rest.turning += length(*kick);
    rest.closeness += length(through) * length(state.position - gates);
    rest.kick += *kick;
  }
  return rest;
}

Vec3d middle_of_portals(const Space& space) {
  Box box;
  for (const Portal& portal : space.portals.portals())
    for (const Vec3d& vertex : portal.vertices) box.add(vertex);
  return box.empty() ? Vec3d{} : box.middle();
}

}  // namespace portalens
