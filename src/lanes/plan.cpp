#include "lanes/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "core/words.h"
#include "lanes/coupling_plan.h"
#include "lanes/shapes.h"
#include "photon/drift.h"
#include "photon/radau.h"
#include "photon/space.h"

namespace portalens {
namespace {

/// Lanes find the borders of what comes through portals less exactly than the scalar engine: there
/// no step may be as long, as a share of the longest elsewhere.
constexpr double longest_with_portals = 0.85;
/// Floats can't keep a finer one.
constexpr double finest_tolerance = 1e-5;

/// The isolated masses, and all others that pull: of many masses, all are those.
void choose_masses(const Space& space, double graze, LanePlan& plan) {
  if (space.masses.size() <= max_lane_masses + max_lane_isolated_masses)
    plan.isolated = isolated_masses(space, graze, max_lane_isolated_masses);
  auto next = plan.isolated.masses.begin();
  for (std::uint32_t i = 0; i < space.masses.size(); ++i) {
    if (next != plan.isolated.masses.end() && next->mass == i)
      ++next;
    else if (space.masses[i].gm > 0.0)
      plan.stepped.push_back(i);
  }
}

void add_isolated_masses(const Space& space, LanePlan& plan) {
  for (const IsolatedMass& isolated : plan.isolated.masses) {
    const Mass& mass = space.masses[isolated.mass];
    const CrossingTable& table = plan.isolated.tables[isolated.table];
    const CrossingRange<double>& range = table.range();
    const auto influence = static_cast<float>(mass.influence);
    plan.scene.isolated[plan.scene.isolated_count++] = {
        narrow(mass.center - plan.center),
        influence,
        influence * influence,
        static_cast<float>(mass.horizon_radius),
        {static_cast<float>(range.capture), static_cast<float>(range.scale),
         static_cast<float>(range.stretch)},
        table.cells().data()};
  }
}

/// Floats hold its reciprocal to the third power, and no place is told apart so finely.
constexpr double least_core2 = 1e-22;

LaneMass lane_mass(const Space& space, const Mass& mass, Vec3d center) {
  LaneMass lane;
  lane.center = narrow(mass.center - center);
  lane.gm = static_cast<float>(space.medium.uniform_weight() *
                               gravitational_radius(mass.gm, space.physics.c));
  // Never 0: what does not act is counted as 0 times its pull, also where it stands.
  lane.core2 = static_cast<float>(std::max(mass.core * mass.core, least_core2));
  lane.influence = static_cast<float>(mass.influence);
  lane.influence2 = lane.influence * lane.influence;
  const bool ball = mass.has_horizon() && std::isinf(space.medium.greatest_potential);
  lane.horizon = ball ? static_cast<float>(mass.horizon_radius) : -1.0f;
  lane.horizon2 = lane.horizon * lane.horizon;
  lane.bare2 = mass.has_horizon() ? 0.0f : bare2_of(lane.gm, lane.core2);
  return lane;
}

/// What lanes step through: few masses in the scene, or many masses.
void add_masses(const Space& space, LanePlan& plan) {
  std::vector<LaneMass> masses;
  for (const std::uint32_t i : plan.stepped)
    masses.push_back(lane_mass(space, space.masses[i], plan.center));
  add_masses_of_portals(space, plan.center, masses);
  if (masses.size() > max_lane_masses) {
    plan.many = MassGrid(std::move(masses));
    plan.scene.many = plan.many.view();
    return;
  }
  plan.scene.mass_count = static_cast<int>(masses.size());
  std::copy(masses.begin(), masses.end(), plan.scene.masses);
}

/// @return why there is no room for one; empty where there is
std::string portal_refusal(const Space& space) {
  const auto portals = space.portals.portals();
  if (portals.size() > max_lane_portals)
    return fmt::format("{} portals are there (lanes take {})", portals.size(), max_lane_portals);
  for (const Portal& portal : portals)
    if (!std::holds_alternative<Ellipse>(portal.aperture) &&
        portal.vertices.size() > max_lane_edges)
      return fmt::format("portal {} has {} edges (lanes take {})", in_quotes(portal.name),
                         portal.vertices.size(), max_lane_edges);
  return "";
}

/// @pre there is room
void add_portals(const Space& space, Vec3d center, LaneScene& scene) {
  const auto portals = space.portals.portals();
  const auto is_rectangle = [](const Portal& p) { return rectangle_of(p).half_width > 0.0; };
  const bool plain = std::all_of(portals.begin(), portals.end(), is_rectangle);
  scene.all_convex = true;
  for (std::uint32_t i = 0; i < portals.size(); ++i) {
    const Portal& portal = portals[i];
    LanePortal& lane = scene.portals[scene.portal_count++];
    const Rectangle extent = extent_of(portal);
    const LaneOutline* outline = nullptr;
    if (!plain) {
      LaneOutline& added = scene.outlines[scene.outline_count++];
      added = outline_of(portal);
      scene.all_convex = scene.all_convex && added.kind == LaneOutline::Kind::convex;
      if (!is_rectangle(portal)) outline = &added;
    }
    lane = {narrow(portal.frame.origin - center), narrow(portal.frame.right),
            narrow(portal.frame.up), narrow(portal.frame.normal),
            static_cast<float>(extent.half_width), static_cast<float>(extent.half_height), outline,
            // Floats may put a step's end behind a plane that it has not reached yet.
            static_cast<float>(std::max(portal.height_tolerance(), 1e-7 * space.extent)),
            portal.has_back() ? 1.0f : 0.0f,
            LanePlan::departed_from(space.portals.plane_of(i).plane),
            static_cast<float>(space.portals.plane_of(i).side)};
  }
}

void add_box(const Box& box, Vec3d center, LaneScene& scene) {
  // Rounded outwards, and joined to the last where there is no room.
  const double slack = 1e-6 * (length(box.low - center) + length(box.high - center));
  const Vec3d more{slack, slack, slack};
  const LaneVec low = narrow(box.low - center - more), high = narrow(box.high - center + more);
  if (scene.box_count < max_lane_boxes) {
    scene.boxes[scene.box_count++] = {low, high};
    return;
  }
  LaneBox& last = scene.boxes[max_lane_boxes - 1];
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

void add_surfaces(const Space& space, LanePlan& plan) {
  LaneScene& scene = plan.scene;
  const Vec3d center = plan.center;
  const auto& shapes = space.surfaces.shapes();
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const auto* quad = std::get_if<Quad>(&shapes[i]);
    const auto* sphere = std::get_if<Sphere>(&shapes[i]);
    if (quad && scene.polygon_count < max_lane_polygons) {
      add_polygon(space, *quad, static_cast<int>(i), center, scene);
    } else if (sphere && scene.sphere_count < max_lane_spheres) {
      scene.spheres[scene.sphere_count++] = {narrow(sphere->center() - center),
                                             static_cast<float>(sphere->radius()),
                                             static_cast<int>(i)};
    } else {
      plan.boxed.push_back(static_cast<std::uint32_t>(i));
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

/// Names a mass or portal that is so far from the middle, for its size, that floats can't tell
/// places by it apart.
std::string strewn_refusal(const Space& space, Vec3d center) {
  constexpr double most = 2e4;
  const auto refusal = [&](const char* what, const std::string& name, Vec3d place, double size,
                           const char* of_it) -> std::string {
    if (!(length(place - center) > most * size)) return "";
    return fmt::format(
        "{} {} lies further off than {:g} times {}: floats can't tell places there "
        "apart",
        what, in_quotes(name), most, of_it);
  };
  for (const Mass& mass : space.masses)
    if (mass.gm > 0.0)
      if (auto why = refusal("mass", mass.name, mass.center, mass.influence, "its influence");
          !why.empty())
        return why;
  for (const Portal& portal : space.portals.portals())
    if (auto why = refusal("portal", portal.name, portal.frame.origin, portal.longest_edge,
                           "its longest edge");
        !why.empty())
      return why;
  return "";
}

/// How far from `center` anything lies that a photon can meet or feel.
double radius_about(const Space& space, Vec3d center) {
  double radius = 0.0;
  if (const Box box = space.surfaces.bounds(); !box.empty())
    radius = 0.5 * box.diagonal() + length(box.middle() - center);
  for (const Portal& portal : space.portals.portals())
    for (const Vec3d& vertex : portal.vertices) radius = std::max(radius, length(vertex - center));
  for (const Mass& mass : space.masses)
    radius = std::max(radius, length(mass.center - center) + mass.influence + mass.horizon_radius);
  return radius;
}

/// Floats hold lengths between these, and what is computed of them: powers up to the fourth and
/// their reciprocals, and m/d⁵ next to a mass. Held by tests/photon/scales_test.cpp.
constexpr double least_extent = 1e-6, largest_extent = 1e8, least_radius = 2e-9;

/// Names a length that is too small or too large for floats.
std::string scale_refusal(const Space& space, const LanePlan& plan) {
  const double radius = radius_about(space, plan.center);
  if (space.extent < least_extent || radius > largest_extent)
    return fmt::format(
        "the scene is {:.3g} in size, influences counted (lanes take {:g} to {:g}; "
        "another unit of length would do)",
        std::max(space.extent, 2.0 * radius), least_extent, 2.0 * largest_extent);
  for (const std::uint32_t i : plan.stepped) {
    const Mass& mass = space.masses[i];
    const double nearest = std::max(gravitational_radius(mass.gm, space.physics.c), mass.core);
    if (nearest < least_radius)
      return fmt::format(
          "G M / c² of mass {} is {:.3g} (lanes take {:g}, or a core_radius of "
          "that)",
          in_quotes(mass.name), nearest, least_radius);
  }
  return "";
}

/// What of the physics lanes don't do.
std::string physics_refusal(const Space& space) {
  const Physics& physics = space.physics;
  if (physics.integrator != Radau::name)
    return fmt::format("physics.integrator is {} (lanes take \"{}\")",
                       in_quotes(physics.integrator), Radau::name);
  if (physics.tolerance < finest_tolerance)
    return fmt::format("physics.tolerance {:g} is finer than floats keep (lanes take {:g})",
                       physics.tolerance, finest_tolerance);
  if (space.unbounded)
    return "an influence is infinite (physics.min_force = 0; lanes take any that is greater)";
  if (space.masses.size() > max_lane_many)
    return fmt::format("{} masses are there (lanes take {})", space.masses.size(), max_lane_many);
  return "";
}

/// What of a law that is not uniform lanes don't do.
std::string law_refusal(const Space& space, const LaneScene& scene) {
  if (space.medium.uniform) return "";
  const std::string law = fmt::format("physics.law is {}", in_quotes(space.physics.law));
  const auto distance_to_support = [&](const auto& coupling) {
    return coupling.distance_to_support(Vec3d{});
  };
  if (!std::isinf(std::visit(distance_to_support, space.coupling)))
    return law +
           " and masses act through portals (lanes take that law with physics.portal_gravity = "
           "\"none\", or the laws \"newton\" and \"einstein\")";
  if (scene.many.count > 0)
    return fmt::format("{} and {} masses act (lanes take {} under that law)", law, scene.many.count,
                       max_lane_masses);
  return "";
}

/// How far past a border a step ends: so far that floats know it from the border, but no further
/// than what the pull that begins or ends there turns a path by meanwhile is nothing beside the
/// tolerance.
double overshoot_for(const Space& space, double ahead) {
  const Physics& physics = space.physics;
  const double bend = space.medium.far_weight * strongest_onset(space) / (physics.c * physics.c);
  return std::clamp(0.03 * physics.tolerance / bend, 0.1 * ahead, ahead);
}

void set_steps(const Space& space, bool looks_through, double ahead, LanePlan& plan) {
  const Physics& physics = space.physics;
  LaneScene& scene = plan.scene;
  const Radau step = Radau::from({physics.step, physics.tolerance});
  scene.stiffness_weight = static_cast<float>(step.stiffness_weight);
  scene.nearness_weight = static_cast<float>(
      step.nearness_weight / (looks_through ? std::pow(longest_with_portals, 4) : 1.0));
  scene.third_weight = static_cast<float>(step.third_weight);
  scene.tolerance = static_cast<float>(physics.tolerance);
  scene.max_drift = static_cast<float>(trusted_drift_in_lanes(physics.tolerance));
  scene.max_absorbed = static_cast<float>(absorbed_drift);
  scene.feedback_weight = static_cast<float>(step.feedback_weight);
  scene.overshoot = static_cast<float>(overshoot_for(space, ahead));
  scene.ahead = static_cast<float>(ahead);
  scene.farthest = static_cast<float>(2.0 * space.extent);
  const double radius = radius_about(space, plan.center);
  scene.radius = static_cast<float>(1.001 * radius);
  scene.flight_limit = static_cast<float>(8.0 * radius);
  scene.max_length = static_cast<float>(std::min(physics.max_length, 1e30));
  scene.max_turning = static_cast<float>(std::min(physics.max_turning, 1e30));
  scene.max_steps = static_cast<float>(physics.max_steps);
}

/// Lays all out, and stops where it can't.
/// @return why; empty where the plan is whole
std::string lay_out(const Space& space, LanePlan& plan) {
  if (std::string why = physics_refusal(space); !why.empty()) return why;
  const double ahead = 1e-6 * space.extent, graze = 4.0 * ahead;
  choose_masses(space, graze, plan);
  plan.scene = {};
  plan.center = center_of(space);
  if (std::string why = scale_refusal(space, plan); !why.empty()) return why;
  if (std::string why = strewn_refusal(space, plan.center); !why.empty()) return why;
  if (std::string why = portal_refusal(space); !why.empty()) return why;
  LaneScene& scene = plan.scene;
  scene.graze2 = static_cast<float>(graze * graze);
  scene.law = static_cast<int>(space.law.index());
  add_masses(space, plan);
  add_isolated_masses(space, plan);
  add_portals(space, plan.center, scene);
  if (std::string why = add_coupling(space, plan); !why.empty()) return why;
  if (std::string why = law_refusal(space, scene); !why.empty()) return why;
  const bool looks_through = scene.gate_count + scene.map_count + scene.way_count > 0;
  if (looks_through && scene.many.count > 0)
    return fmt::format("through portals {} masses act (lanes take {})", scene.many.count,
                       max_lane_masses);
  add_surfaces(space, plan);
  add_narrow_gaps(space, plan.center, scene);
  set_steps(space, looks_through, ahead, plan);
  return "";
}

}  // namespace

LaneChoice plan_lanes(const Space& space) {
  auto plan = std::make_unique<LanePlan>();
  if (std::string why = lay_out(space, *plan); !why.empty()) return {nullptr, std::move(why)};
  return {std::move(plan), ""};
}

}  // namespace portalens
