#include "lanes/plan.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lanes/coupling_layout.h"
#include "lanes/face_plan.h"
#include "lanes/limits.h"
#include "lanes/narrow.h"
#include "lanes/surface_plan.h"
#include "photon/drift.h"
#include "photon/radau.h"
#include "photon/space.h"

namespace portalens {
namespace {

/// How long a step of lanes may be, as a share of the scalar engine's. Fitted with those lengths
/// (photon/radau.h).
constexpr double longest_in_lanes = 0.648 / 0.6498;
/// Lanes find the borders of what comes through portals less exactly than the scalar engine: there
/// no step may be as long, as a share of the longest elsewhere.
constexpr double longest_with_portals = 0.85;
/// Splits the masses into isolated ones and others that pull. Of more masses than lanes hold one by
/// one, none counts as isolated.
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
/// @param of_portals  what acts as masses do, besides
void add_masses(const Space& space, const std::vector<LaneMass>& of_portals, LanePlan& plan) {
  std::vector<LaneMass> masses;
  for (const std::uint32_t i : plan.stepped)
    masses.push_back(lane_mass(space, space.masses[i], plan.center));
  masses.insert(masses.end(), of_portals.begin(), of_portals.end());
  if (masses.size() > max_lane_masses) {
    plan.many = MassGrid(std::move(masses));
    plan.scene.many = plan.many.view();
    return;
  }
  plan.scene.mass_count = static_cast<int>(masses.size());
  std::copy(masses.begin(), masses.end(), plan.scene.masses);
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
      added = lay_out_face(portal).outline;
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
  if (plain) return;
  for (std::size_t i = portals.size(); i < space.mouths.size(); ++i)
    scene.outlines[scene.outline_count++] = lay_out_face(space.mouths[i]).outline;
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

/// How far past a border a step ends: so far that floats know it from the border, but no further
/// than what the pull that begins or ends there turns a path by meanwhile is nothing beside the
/// tolerance.
double overshoot_for(const Space& space, double ahead) {
  const Physics& physics = space.physics;
  const double bend = space.medium.far_weight * strongest_onset(space) / (physics.c * physics.c);
  return std::clamp(0.03 * physics.tolerance / bend, 0.1 * ahead, ahead);
}

void set_steps(const Space& space, double ahead, LanePlan& plan) {
  const Physics& physics = space.physics;
  LaneScene& scene = plan.scene;
  const Radau step = Radau::from({physics.step, physics.tolerance});
  const double longest =
      looks_through(scene) ? longest_in_lanes * longest_with_portals : longest_in_lanes;
  scene.stiffness_weight =
      static_cast<float>(step.stiffness_weight / std::pow(longest_in_lanes, 4));
  scene.nearness_weight = static_cast<float>(step.nearness_weight / std::pow(longest, 4));
  scene.third_weight = static_cast<float>(step.third_weight);
  scene.tolerance = static_cast<float>(physics.tolerance);
  const int masses = scene.mass_count + scene.many.count;
  plan.max_drift = trusted_drift_in_lanes(masses, physics.tolerance);
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
  if (std::string why = place_refusal(space, plan); !why.empty()) return why;
  LaneScene& scene = plan.scene;
  scene.graze2 = static_cast<float>(graze * graze);
  scene.law = static_cast<int>(space.law.index());
  add_portals(space, plan.center, scene);
  std::vector<LaneMass> of_portals;
  if (std::string why = add_coupling(space, plan, of_portals); !why.empty()) return why;
  add_masses(space, of_portals, plan);
  add_isolated_masses(space, plan);
  if (std::string why = field_refusal(space, scene); !why.empty()) return why;
  add_surfaces(space, plan);
  set_steps(space, ahead, plan);
  return "";
}

}  // namespace

LaneChoice plan_lanes(const Space& space) {
  auto plan = std::make_unique<LanePlan>();
  if (std::string why = lay_out(space, *plan); !why.empty()) return {nullptr, std::move(why)};
  return {std::move(plan), ""};
}

}  // namespace portalens
