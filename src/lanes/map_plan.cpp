// How lanes hold `graviton-map`.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gravity/attraction.h"
#include "gravity/bound_light.h"
#include "lanes/coupling_layout.h"
#include "lanes/face_plan.h"
#include "photon/space.h"

namespace portalens {
namespace {

LaneMap map_of(const GravitonGrid& grid, const LaneFace& face, float max_nearness) {
  return {face,
          static_cast<float>(grid.low_x()),
          static_cast<float>(grid.low_y()),
          static_cast<float>(grid.spacing_x()),
          static_cast<float>(grid.spacing_y()),
          static_cast<float>(1.0 / grid.spacing_x()),
          static_cast<float>(1.0 / grid.spacing_y()),
          static_cast<float>(grid.count_x() - 2),
          static_cast<float>(grid.count_y() - 2),
          static_cast<int>(grid.count_x()),
          max_nearness,
          nullptr,
          nullptr};
}

void add_nodes(const GravitonGrid& grid, double inverse_c2, LanePlan& plan) {
  const auto put = [](std::vector<float>& table, double value) {
    table.push_back(static_cast<float>(value));
  };
  for (std::uint32_t j = 0; j < grid.count_y(); ++j)
    for (std::uint32_t i = 0; i < grid.count_x(); ++i) {
      const Pull& node = grid.node(i, j);
      const Vec3d bend = node.acceleration * inverse_c2;
      for (const double value : {bend.x, bend.y, bend.z}) put(plan.map_nodes, value);
      put(plan.map_nodes, node.stiffness * inverse_c2 * distant_weight);
      const GravitonGrid::Cell cell{std::min(i, grid.count_x() - 2),
                                    std::min(j, grid.count_y() - 2)};
      put(plan.map_cells, grid.nearness(cell));
      put(plan.map_cells, grid.to_sharp(cell));
      put(plan.map_cells, std::min(grid.gradient(cell) * inverse_c2, 1e30));
    }
}

}  // namespace

float CouplingLayout::max_nearness(std::uint32_t portal) const {
  double most = 1e30;  // no cell's
  for (const BoundLight& light :
       bound_light(GravitonMapCoupling::name, space_.mouths, space_.masses, space_.physics.c,
                   space_.medium.light_sphere)) {
    if (light.portal != portal) continue;
    const double m = light_sphere(space_, space_.masses[light.mass].gm);
    most = std::min(most, std::pow(too_near_through * m, -4.0));
  }
  return static_cast<float>(most);
}

std::string CouplingLayout::maps(const GravitonMapCoupling& coupling) {
  const std::vector<Portal>& portals = space_.mouths;
  const double inverse_c2 = space_.medium.uniform_weight() / (space_.physics.c * space_.physics.c);
  std::vector<std::size_t> first;
  for (std::uint32_t a = 0; a < portals.size(); ++a) {
    const double reach = coupling.exact().reach(a);
    if (!(reach > 0.0)) continue;
    if (plan_.scene.map_count == max_lane_portals)
      return fmt::format("more than {} sides of portals act (lanes take {})", max_lane_portals,
                         max_lane_portals);
    LaneFace face = face_of(portals[a], plan_.center, reach, space_.extent);
    if (plan_.scene.outline_count > 0) face.outline = &plan_.scene.outlines[a];
    plan_.scene.maps[plan_.scene.map_count++] = map_of(coupling.grid(a), face, max_nearness(a));
    first.push_back(plan_.map_cells.size() / 3);
    add_nodes(coupling.grid(a), inverse_c2, plan_);
  }
  // Now that the tables grow no more.
  for (std::size_t i = 0; i < first.size(); ++i) {
    plan_.scene.maps[i].nodes = plan_.map_nodes.data() + 4 * first[i];
    plan_.scene.maps[i].cells = plan_.map_cells.data() + 3 * first[i];
  }
  return "";
}

}  // namespace portalens
