// How lanes hold `shortest-path`.
#include <fmt/format.h>

#include <cmath>

#include "gravity/bound_light.h"
#include "lanes/coupling_layout.h"
#include "lanes/face_plan.h"
#include "lanes/narrow.h"
#include "photon/space.h"

namespace portalens {

float CouplingLayout::bare2_of_way(const ShortestPathCoupling::Image& image, const Portal& portal) {
  const Mass& mass = space_.masses[image.mass];
  const double m = light_sphere(space_, image.gm);
  if (!(felt_from(space_.mouths[portal.pair], mass) < m)) return 0.0f;
  plan_.scene.bare_through = true;
  return static_cast<float>(too_near_through * too_near_through * m * m);
}

/// Chains of one portal only.
std::string CouplingLayout::shortest_paths(const ShortestPathCoupling& coupling) {
  for (const Portal& portal : space_.mouths)
    if (is_curved(portal.aperture))
      return fmt::format("portal {} is an {} (with shortest-path lanes take polygons)",
                         in_quotes(portal.name), name_of(portal.aperture));
  LaneScene& scene = plan_.scene;
  if (coupling.images().size() > max_lane_ways)
    return fmt::format("shortest-path has {} paths from masses through portals (lanes take {})",
                       coupling.images().size(), max_lane_ways);
  std::uint32_t entered = no_portal;
  for (const ShortestPathCoupling::Image& image : coupling.images()) {
    const std::vector<std::uint32_t> chain = coupling.chain(image);
    if (chain.size() > 1)
      return "shortest-path goes through portals in a row (lanes take "
             "physics.portal_gravity_depth = 1)";
    const Portal& portal = space_.mouths[chain.front()];
    // Images come portal by portal.
    if (chain.front() != entered && scene.entrance_count == max_lane_portals)
      return fmt::format("more than {} sides of portals act (lanes take {})", max_lane_portals,
                         max_lane_portals);
    if (chain.front() != entered) {
      LaneFace face = face_of(portal, plan_.center, 0.0, space_.extent);
      if (scene.outline_count > 0) face.outline = &scene.outlines[chain.front()];
      scene.entrances[scene.entrance_count++] = {face, scene.way_count, scene.way_count};
    }
    entered = chain.front();
    ++scene.entrances[scene.entrance_count - 1].end;
    const Vec3d local = portal.frame.to_local(image.center);
    const Rectangle rectangle = rectangle_of(portal);
    const auto off = [&](double aside) { return static_cast<float>(std::hypot(aside, local.z)); };
    scene.ways[scene.way_count++] = {
        narrow(local),
        static_cast<float>(space_.medium.uniform_weight() *
                           gravitational_radius(image.gm, space_.physics.c)),
        static_cast<float>(image.core2),
        static_cast<float>(image.influence),
        bare2_of_way(image, portal),
        {off(local.y + rectangle.half_height), off(local.x - rectangle.half_width),
         off(local.y - rectangle.half_height), off(local.x + rectangle.half_width)}};
  }
  return "";
}

}  // namespace portalens
