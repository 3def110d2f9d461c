#include "gravity/bound_light.h"

#include <algorithm>
#include <cmath>

#include "gravity/closest_point_coupling.h"
#include "gravity/graviton_map_coupling.h"
#include "gravity/portal_face.h"
#include "gravity/shortest_path_coupling.h"

namespace portalens {
namespace {

/// The same along the shortest path: what lies behind the plane is reached around an edge only.
double felt_on_the_way(const Portal& exit, const Mass& mass) {
  const PortalFace face(exit);
  const Vec3d local = face.frame().to_local(mass.center);
  return std::hypot(length(local - face.place(face.nearest(local), local)), mass.core);
}

}  // namespace

double felt_from(const Portal& exit, const Mass& mass) {
  const double distance = PortalFace(exit).distance(mass.center);
  // What lies on the face but for rounding.
  return std::hypot(distance <= exit.height_tolerance() ? 0.0 : distance, mass.core);
}

std::vector<BoundLight> bound_light(std::string_view coupling, std::span<const Portal> portals,
                                    std::span<const Mass> masses, double c, double light_sphere) {
  const bool along_ways = coupling == ShortestPathCoupling::name;
  std::vector<BoundLight> found;
  if (!along_ways && coupling != ClosestPointCoupling::name &&
      coupling != GravitonMapCoupling::name)
    return found;
  for (std::uint32_t i = 0; i < masses.size(); ++i)
    for (std::uint32_t a = 0; a < portals.size(); ++a) {
      const Portal& exit = portals[portals[a].pair];
      // The faces' frames take time; most masses are far.
      if (!binds(masses[i],
                 length(masses[i].center - exit.frame.origin) -
                     static_cast<double>(exit.vertices.size()) * exit.longest_edge,
                 c, light_sphere))
        continue;
      double distance = felt_from(exit, masses[i]);
      if (along_ways && binds(masses[i], distance, c, light_sphere))
        distance = std::max(distance, felt_on_the_way(exit, masses[i]));
      if (binds(masses[i], distance, c, light_sphere)) found.push_back({i, a, distance});
    }
  return found;
}

}  // namespace portalens
