#include "photon/lane_plan.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "photon/lane_couplings.h"
#include "photon/lane_shapes.h"
#include "photon/radau.h"
#include "photon/space.h"

namespace portalens {
namespace {

/// Lanes find the borders of what comes through portals less exactly than the scalar engine: there
/// no step may be as long, as a share of the longest elsewhere.
constexpr double longest_with_portals = 0.85;
/// Floats can't keep a finer one.
constexpr double finest_tolerance = 1e-5;

/// The lone masses, and all others: of many masses, all are those.
/// @return false if there is not room enough
bool choose_masses(const Space& space, double graze, LanePlan& plan) {
  if (space.masses.size() > most_lane_crowd) return false;
  if (space.masses.size() <= most_lane_masses + most_lane_lone_masses)
    plan.lone = lone_masses(space, graze, most_lane_lone_masses);
  auto next = plan.lone.masses.begin();
  for (std::uint32_t i = 0; i < space.masses.size(); ++i) {
    if (next != plan.lone.masses.end() && next->mass == i)
      ++next;
    else
      plan.stepped.push_back(i);
  }
  return true;
}

void add_lone_masses(const Space& space, LanePlan& plan) {
  for (const LoneMass& lone : plan.lone.masses) {
    const Mass& mass = space.masses[lone.mass];
    const CrossingTable& table = plan.lone.tables[lone.table];
    const CrossingRange<double>& range = table.range();
    const auto influence = static_cast<float>(mass.influence);
    plan.scene.lone[plan.scene.lone_count++] = {
        narrow(mass.center - plan.center),
        influence,
        influence * influence,
        static_cast<float>(mass.schwarzschild),
        {static_cast<float>(range.capture), static_cast<float>(range.scale),
         static_cast<float>(range.stretch)},
        table.cells().data()};
  }
}

LaneMass lane_mass(const Mass& mass, Vec3d center, double c) {
  LaneMass lane;
  lane.center = narrow(mass.center - center);
  lane.gm = static_cast<float>(gravitational_radius(mass.gm, c));
  lane.core2 = static_cast<float>(mass.core * mass.core);
  lane.influence = static_cast<float>(mass.influence);
  lane.influence2 = lane.influence * lane.influence;
  lane.horizon = mass.has_horizon() ? static_cast<float>(mass.schwarzschild) : -1.0f;
  lane.horizon2 = lane.horizon * lane.horizon;
  lane.bare2 = mass.has_horizon() ? 0.0f : bare2_of(lane.gm, lane.core2);
  return lane;
}

/// What lanes step through: few masses in the scene, or a crowd.
void add_masses(const Space& space, LanePlan& plan) {
  std::vector<LaneMass> masses;
  for (const std::uint32_t i : plan.stepped)
    masses.push_back(lane_mass(space.masses[i], plan.center, space.physics.c));
  add_masses_of_portals(space, plan.center, masses);
  if (masses.size() > most_lane_masses) {
    plan.crowd = CrowdGrid(std::move(masses));
    plan.scene.crowd = plan.crowd.view();
    return;
  }
  plan.scene.mass_count = static_cast<int>(masses.size());
  std::copy(masses.begin(), masses.end(), plan.scene.masses);
}

bool add_portals(const Space& space, Vec3d center, LaneScene& scene) {
  const auto portals = space.portals.portals();
  if (portals.size() > most_lane_portals) return false;
  const auto is_rectangle = [](const Portal& p) { return rectangle_of(p).half_width > 0.0; };
  const bool plain = std::all_of(portals.begin(), portals.end(), is_rectangle);
  for (std::uint32_t i = 0; i < portals.size(); ++i) {
    const Portal& portal = portals[i];
    if (portal.vertices.size() > most_lane_edges) return false;
    LanePortal& lane = scene.portals[scene.portal_count++];
    const Rectangle extent = extent_of(portal);
    const LaneOutline* outline = nullptr;
    if (!plain) {
      LaneOutline& added = scene.outlines[scene.outline_count++];
      added = outline_of(portal);
      if (!is_rectangle(portal)) outline = &added;
    }
    lane = {narrow(portal.frame.origin - center),
            narrow(portal.frame.right),
            narrow(portal.frame.up),
            narrow(portal.frame.normal),
            static_cast<float>(extent.half_width),
            static_cast<float>(extent.half_height),
            outline,
            static_cast<float>(portal.height_tolerance()),
            portal.has_back() ? 1.0f : 0.0f,
            LanePlan::departed_from(space.portals.plane_of(i).plane),
            static_cast<float>(space.portals.plane_of(i).side)};
  }
  return true;
}

void add_box(const Box& box, Vec3d center, LaneScene& scene) {
  // Rounded outwards, and joined to the last where there is no room.
  const double slack = 1e-6 * (length(box.low - center) + length(box.high - center));
  const Vec3d more{slack, slack, slack};
  const LaneVec low = narrow(box.low - center - more), high = narrow(box.high - center + more);
  if (scene.box_count < most_lane_boxes) {
    scene.boxes[scene.box_count++] = {low, high};
    return;
  }
  LaneBox& last = scene.boxes[most_lane_boxes - 1];
  last.low = {std::min(last.low.x, low.x), std::min(last.low.y, low.y),
              std::min(last.low.z, low.z)};
  last.high = {std::max(last.high.x, high.x), std::max(last.high.y, high.y),
               std::max(last.high.z, high.z)};
}

void add_polygon(const Space& space, const Quad& quad, int shape, Vec3d center, LaneScene& scene) {
  LanePolygon& lane = scene.polygons[scene.polygon_count++];
  const auto vertices = quad.vertices();
  const Vec3d normal = quad.normal();
  lane.normal = narrow(normal);
  lane.distance = static_cast<float>(dot(vertices[0] - center, normal));
  lane.shape = shape;
  const auto* place = space.surfaces.flush().find(static_cast<std::uint32_t>(shape), 0);
  lane.leaves = place ? LanePlan::departed_from(place->plane) : static_cast<float>(shape);
  lane.facing = place ? static_cast<float>(place->side) : 1.0f;
  const Vec3d middle = quad.bounds().middle();
  double radius = 0.0;
  for (const Vec3d& vertex : vertices) radius = std::max(radius, length(vertex - middle));
  lane.middle = narrow(middle - center);
  lane.radius = static_cast<float>(radius + 1e-6 * (radius + length(middle - center)));
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t k = i % vertices.size();
    const Vec3d from = vertices[k], to = vertices[(k + 1) % vertices.size()];
    const Vec3d inwards = normalize(cross(normal, to - from));
    lane.edge_normal[i] = narrow(inwards);
    // A little generous: the hit is computed again in double.
    const double slack = 1e-6 * (length(from - center) + length(to - from));
    lane.edge_distance[i] = static_cast<float>(dot(from - center, inwards) - slack);
  }
}

void add_surfaces(const Space& space, Vec3d center, LaneScene& scene) {
  const auto& shapes = space.surfaces.shapes();
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const auto* quad = std::get_if<Quad>(&shapes[i]);
    const auto* sphere = std::get_if<Sphere>(&shapes[i]);
    if (quad && scene.polygon_count < most_lane_polygons) {
      add_polygon(space, *quad, static_cast<int>(i), center, scene);
    } else if (sphere && scene.sphere_count < most_lane_spheres) {
      scene.spheres[scene.sphere_count++] = {narrow(sphere->center() - center),
                                             static_cast<float>(sphere->radius()),
                                             static_cast<int>(i)};
    } else {
      add_box(std::visit([](const auto& shape) { return shape.bounds(); }, shapes[i]), center,
              scene);
    }
  }
}

Vec3d lowest(Vec3d a, Vec3d b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
Vec3d highest(Vec3d a, Vec3d b) { return -lowest(-a, -b); }

/// A polygon that lanes look at.
struct Thin {
  std::span<const Vec3d> vertices;
  Vec3d normal;
  std::uint32_t plane;  ///< as `FlushFaces` tells them, or `LeftPlane::none`
  Box box;

  /// Whether all of it lies that close to the plane of another.
  [[nodiscard]] bool hugs(const Thin& other, double distance) const {
    return std::all_of(vertices.begin(), vertices.end(), [&](const Vec3d& vertex) {
      return std::fabs(dot(vertex - other.vertices[0], other.normal)) <= distance;
    });
  }
};

/// Where faces lie one behind the other, closer than floats can tell, the scalar engine looks.
void add_narrow_gaps(const Space& space, Vec3d center, LaneScene& scene) {
  std::vector<Thin> thin;
  for (int p = 0; p < scene.polygon_count; ++p) {
    const auto shape = static_cast<std::uint32_t>(scene.polygons[p].shape);
    const Quad& quad = std::get<Quad>(space.surfaces.shapes()[shape]);
    const auto* place = space.surfaces.flush().find(shape, 0);
    thin.push_back(
        {quad.vertices(), quad.normal(), place ? place->plane : LeftPlane::none, quad.bounds()});
  }
  for (std::uint32_t i = 0; i < space.portals.portals().size(); ++i) {
    const Portal& portal = space.portals.portals()[i];
    Box box;
    for (const Vec3d& vertex : portal.vertices) box.add(vertex);
    thin.push_back({portal.vertices, portal.frame.normal, space.portals.plane_of(i).plane, box});
  }
  Box all;
  for (const Thin& face : thin) all.add(face.box);
  if (space.viewpoint) all.add(*space.viewpoint);
  if (all.empty()) return;
  const double closest = 1e-6 * (length(all.middle() - center) + all.diagonal());
  for (std::size_t i = 0; i < thin.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Thin &a = thin[i], &b = thin[j];
      if (a.plane == b.plane && a.plane != LeftPlane::none) continue;
      const bool a_is_smaller = a.box.diagonal() < b.box.diagonal();
      if (!(a_is_smaller ? a.hugs(b, closest) : b.hugs(a, closest))) continue;
      const Vec3d low = highest(a.box.low, b.box.low), high = lowest(a.box.high, b.box.high);
      const Box shared = Box{low, high}.grown(closest);
      if (shared.low == lowest(shared.low, shared.high)) add_box(shared, center, scene);
    }
}

/// The middle of what is solid; floats are finest there.
Vec3d center_of(const Space& space) {
  Box box;
  for (const Mass& mass : space.masses) box.add(mass.center);
  for (const Portal& portal : space.portals.portals())
    for (const Vec3d& vertex : portal.vertices) box.add(vertex);
  if (box.empty()) box = space.surfaces.bounds();
  return box.empty() ? Vec3d{} : box.middle();
}

/// Whether some mass or portal is so far from the middle, for its size, that floats can't tell
/// places by it apart.
bool is_strewn(const Space& space, Vec3d center) {
  constexpr double most = 2e4;
  const auto lost = [&](Vec3d place, double size) { return length(place - center) > most * size; };
  return std::any_of(space.masses.begin(), space.masses.end(),
                     [&](const Mass& mass) {
                       return mass.gm > 0.0 && lost(mass.center, mass.influence);
                     }) ||
         std::any_of(
             space.portals.portals().begin(), space.portals.portals().end(),
             [&](const Portal& portal) { return lost(portal.frame.origin, portal.longest_edge); });
}

/// How far from `center` anything lies that a photon can meet or feel.
double radius_about(const Space& space, Vec3d center) {
  double radius = 0.0;
  if (const Box box = space.surfaces.bounds(); !box.empty())
    radius = 0.5 * box.diagonal() + length(box.middle() - center);
  for (const Portal& portal : space.portals.portals())
    for (const Vec3d& vertex : portal.vertices) radius = std::max(radius, length(vertex - center));
  for (const Mass& mass : space.masses)
    radius = std::max(radius, length(mass.center - center) + mass.influence + mass.schwarzschild);
  return radius;
}

}  // namespace

std::unique_ptr<const LanePlan> plan_lanes(const Space& space) {
  const Physics& physics = space.physics;
  if (physics.integrator != Radau::name || physics.tolerance < finest_tolerance || space.unbounded)
    return nullptr;
  auto plan = std::make_unique<LanePlan>();
  const double overshoot = 1e-6 * space.extent, graze = 4.0 * overshoot;
  if (!choose_masses(space, graze, *plan)) return nullptr;
  plan->scene = {};
  plan->center = center_of(space);
  if (is_strewn(space, plan->center)) return nullptr;
  LaneScene& scene = plan->scene;
  scene.graze2 = static_cast<float>(graze * graze);
  add_masses(space, *plan);
  add_lone_masses(space, *plan);
  if (!add_portals(space, plan->center, scene)) return nullptr;
  if (!add_coupling(space, *plan)) return nullptr;
  const bool looks_through = scene.gate_count + scene.map_count + scene.way_count > 0;
  if (looks_through && scene.crowd.count > 0) return nullptr;
  add_surfaces(space, plan->center, scene);
  add_narrow_gaps(space, plan->center, scene);

  const Radau step = Radau::from({physics.step, physics.tolerance});
  scene.stiffness_weight = static_cast<float>(step.stiffness_weight);
  scene.nearness_weight = static_cast<float>(
      step.nearness_weight / (looks_through ? std::pow(longest_with_portals, 4) : 1.0));
  scene.overshoot = static_cast<float>(overshoot);
  scene.ahead = scene.overshoot;
  scene.farthest = static_cast<float>(2.0 * space.extent);
  const double radius = radius_about(space, plan->center);
  scene.radius = static_cast<float>(1.001 * radius);
  scene.flight_limit = static_cast<float>(8.0 * radius);
  scene.max_length = static_cast<float>(std::min(physics.max_length, 1e30));
  scene.max_turning = static_cast<float>(std::min(physics.max_turning, 1e30));
  scene.max_steps = static_cast<float>(physics.max_steps);
  return plan;
}

}  // namespace portalens
