#include "photon/lane_plan.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "photon/nystrom.h"
#include "photon/space.h"

namespace portalens {
namespace {

/// Floats can't keep a finer one.
constexpr double finest_tolerance = 1e-5;

LaneVec narrow(Vec3d v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// Half width and height of a portal that is a rectangle about its frame, else 0 and 0.
struct Rectangle {
  double half_width = 0.0, half_height = 0.0;
};

Rectangle rectangle_of(const Portal& portal) {
  if (portal.vertices.size() != 4) return {};
  const Vec3d corner = portal.frame.to_local(portal.vertices[2]);
  const Vec3d expected[4] = {{-corner.x, -corner.y, 0},
                             {corner.x, -corner.y, 0},
                             {corner.x, corner.y, 0},
                             {-corner.x, corner.y, 0}};
  for (int i = 0; i < 4; ++i)
    if (length(portal.frame.to_local(portal.vertices[i]) - expected[i]) >
        1e-9 * portal.longest_edge)
      return {};
  return {corner.x, corner.y};
}

/// Builds the tree of gates that `closest-point` recurses through.
class GatePlanner {
 public:
  GatePlanner(const Space& space, const ClosestPointCoupling& coupling, Vec3d center,
              LaneScene& scene)
      : space_(space), coupling_(coupling), center_(center), scene_(scene) {}

  /// False if there is not room enough.
  [[nodiscard]] bool plan() { return add(coupling_.depth(), -1, no_portal, nullptr); }

 private:
  [[nodiscard]] bool add(int depth, int parent, std::uint32_t left_out, const Portal* entered) {
    const auto portals = space_.portals.portals();
    if (depth <= 0) return true;
    for (std::uint32_t a = 0; a < portals.size(); ++a) {
      const double reach = coupling_.reach(a, depth);
      if (a == left_out || !(reach > 0.0)) continue;
      if (scene_.gate_count == most_lane_gates) return false;
      const int index = scene_.gate_count++;
      fill(scene_.gates[index], portals[a], reach, parent, entered);
      if (!add(depth - 1, index, portals[a].pair, &portals[a])) return false;
    }
    return true;
  }

  void fill(LaneGate& gate, const Portal& portal, double reach, int parent,
            const Portal* entered) const {
    const Frame& frame = portal.frame;
    const Frame& beyond = space_.portals.portals()[portal.pair].frame;
    const Rectangle rectangle = rectangle_of(portal);
    gate = {};
    gate.parent = parent;
    gate.origin = narrow(frame.origin - center_);
    gate.right = narrow(frame.right);
    gate.up = narrow(frame.up);
    gate.normal = narrow(frame.normal);
    if (entered) {
      const Frame& out = space_.portals.portals()[entered->pair].frame;
      gate.offset = narrow(frame.to_local(out.origin));
      gate.by_x = narrow(frame.direction_to_local(-out.right));
      gate.by_y = narrow(frame.direction_to_local(out.up));
      const auto back = [&](Vec3d axis) {
        return narrow({-dot(axis, out.right), dot(axis, out.up), -dot(axis, out.normal)});
      };
      gate.to_parent_x = back(frame.right);
      gate.to_parent_y = back(frame.up);
      gate.to_parent_z = back(frame.normal);
    }
    gate.half_width = static_cast<float>(rectangle.half_width);
    gate.half_height = static_cast<float>(rectangle.half_height);
    gate.tolerance = static_cast<float>(portal.height_tolerance());
    gate.reach = static_cast<float>(reach);
    gate.reach2 = gate.reach * gate.reach;
    for (std::size_t i = 0; i < space_.masses.size(); ++i) {
      const Vec3d seen = beyond.to_local(space_.masses[i].center);
      gate.images[i] = narrow({-seen.x, seen.y, -seen.z});
    }
  }

  const Space& space_;
  const ClosestPointCoupling& coupling_;
  Vec3d center_;
  LaneScene& scene_;
};

void add_masses(const Space& space, Vec3d center, LaneScene& scene) {
  for (const Mass& mass : space.masses) {
    LaneMass& lane = scene.masses[scene.mass_count++];
    lane.center = narrow(mass.center - center);
    lane.gm = static_cast<float>(gravitational_radius(mass.gm, space.physics.c));
    lane.core2 = static_cast<float>(mass.core * mass.core);
    lane.influence = static_cast<float>(mass.influence);
    lane.influence2 = lane.influence * lane.influence;
    lane.horizon = mass.horizon && mass.gm > 0.0 ? static_cast<float>(mass.schwarzschild) : -1.0f;
    lane.horizon2 = lane.horizon * lane.horizon;
  }
}

bool add_portals(const Space& space, Vec3d center, LaneScene& scene) {
  const auto portals = space.portals.portals();
  if (portals.size() > most_lane_portals) return false;
  for (const Portal& portal : portals) {
    const Rectangle rectangle = rectangle_of(portal);
    if (rectangle.half_width == 0.0) return false;
    LanePortal& lane = scene.portals[scene.portal_count++];
    lane = {narrow(portal.frame.origin - center),
            narrow(portal.frame.right),
            narrow(portal.frame.up),
            narrow(portal.frame.normal),
            static_cast<float>(rectangle.half_width),
            static_cast<float>(rectangle.half_height),
            static_cast<float>(portal.height_tolerance()),
            portal.back_material ? 1.0f : 0.0f};
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

void add_polygon(const Quad& quad, int shape, Vec3d center, LaneScene& scene) {
  LanePolygon& lane = scene.polygons[scene.polygon_count++];
  const auto vertices = quad.vertices();
  const Vec3d normal = quad.normal();
  lane.normal = narrow(normal);
  lane.distance = static_cast<float>(dot(vertices[0] - center, normal));
  lane.shape = shape;
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
      add_polygon(*quad, static_cast<int>(i), center, scene);
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

/// The middle of what is solid; floats are finest there.
Vec3d center_of(const Space& space) {
  Box box;
  for (const Mass& mass : space.masses) box.add(mass.center);
  for (const Portal& portal : space.portals.portals())
    for (const Vec3d& vertex : portal.vertices) box.add(vertex);
  if (box.empty()) box = space.surfaces.bounds();
  return box.empty() ? Vec3d{} : box.middle();
}

}  // namespace

std::unique_ptr<const LanePlan> plan_lanes(const Space& space) {
  const Physics& physics = space.physics;
  if (physics.integrator != Nystrom::name || physics.tolerance < finest_tolerance ||
      space.unbounded || space.masses.size() > most_lane_masses)
    return nullptr;
  auto plan = std::make_unique<LanePlan>();
  plan->scene = {};
  plan->center = center_of(space);
  LaneScene& scene = plan->scene;
  add_masses(space, plan->center, scene);
  if (!add_portals(space, plan->center, scene)) return nullptr;
  if (const auto* closest = std::get_if<ClosestPointCoupling>(&space.coupling)) {
    if (!GatePlanner(space, *closest, plan->center, scene).plan()) return nullptr;
  } else if (!std::holds_alternative<NoCoupling>(space.coupling)) {
    return nullptr;
  }
  add_surfaces(space, plan->center, scene);

  const Nystrom step = Nystrom::from({physics.step, physics.tolerance});
  scene.stiffness_weight = static_cast<float>(step.stiffness_weight);
  scene.nearness_weight = static_cast<float>(step.nearness_weight);
  scene.overshoot = static_cast<float>(1e-6 * space.extent);
  scene.ahead = scene.overshoot;
  scene.farthest = static_cast<float>(2.0 * space.extent);
  scene.max_length = static_cast<float>(std::min(physics.max_length, 1e30));
  scene.max_turning = static_cast<float>(std::min(physics.max_turning, 1e30));
  scene.max_steps = static_cast<float>(physics.max_steps);
  return plan;
}

}  // namespace portalens
