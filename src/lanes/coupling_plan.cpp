#include "lanes/coupling_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "core/words.h"
#include "gravity/attraction.h"
#include "gravity/bound_light.h"
#include "gravity/portal_face.h"
#include "lanes/shapes.h"
#include "photon/space.h"

namespace portalens {
namespace {

/// Nearer to a mass of that G M, or an image of one, light winds in.
double light_sphere(const Space& space, double gm) {
  return space.medium.light_sphere * gravitational_radius(gm, space.physics.c);
}

/// Light is left to the scalar engine nearer than this many m to a mass that it is bound by through
/// a portal. Within e m it winds in; the field of a point of a face may change much faster than the
/// steps of lanes expect.
constexpr double too_near = 4.0;

double farthest(const Portal& portal, Vec3d from) {
  double distance = 0.0;
  for (const Vec3d& vertex : portal.vertices) distance = std::max(distance, length(vertex - from));
  return distance;
}

/// Radius of a ball about the middle of a portal, out of which it does not act; with a slack beside
/// which a float's rounding is small.
float ball_about(const Portal& portal, double reach, double extent) {
  return static_cast<float>(1.001 * (reach + farthest(portal, portal.frame.origin)) +
                            1e-5 * extent);
}

/// Builds the tree of gates that `closest-point` recurses through.
class GatePlanner {
 public:
  GatePlanner(const Space& space, const ClosestPointCoupling& coupling, LanePlan& plan)
      : space_(space),
        coupling_(coupling),
        center_(plan.center),
        masses_(plan.stepped),
        scene_(plan.scene) {}

  /// Why it is not possible; empty where it is.
  [[nodiscard]] std::string plan() {
    for (const Portal& portal : space_.mouths)
      if (coupling_.depth() > 0 && std::holds_alternative<Ellipse>(portal.aperture))
        return fmt::format(
            "portal {} is an ellipse (lanes take it with physics.portal_gravity = \"portal-mass\" "
            "or \"none\", and polygons with closest-point, too)",
            in_quotes(portal.name));
    if (add(coupling_.depth(), -1, no_portal, nullptr)) return "";
    if (masses_.size() > max_lane_masses)
      return fmt::format(
          "through portals {} masses act (lanes take {}; with physics.portal_gravity = "
          "\"portal-mass\" or \"none\" they take more)",
          masses_.size(), max_lane_masses);
    return fmt::format(
        "closest-point goes through portals on more than {} paths (a smaller "
        "physics.portal_gravity_depth has fewer)",
        max_lane_gates);
  }

 private:
  /// False if there is not room enough.
  [[nodiscard]] bool add(int depth, int parent, std::uint32_t left_out, const Portal* entered) {
    const std::vector<Portal>& portals = space_.mouths;
    if (depth <= 0) return true;
    for (std::uint32_t a = 0; a < portals.size(); ++a) {
      const double reach = coupling_.reach(a, depth);
      if (a == left_out || !(reach > 0.0)) continue;
      if (scene_.gate_count == max_lane_gates || masses_.size() > max_lane_masses) return false;
      const int index = scene_.gate_count++;
      fill(scene_.gates[index], portals[a], reach, parent, entered);
      if (scene_.outline_count > 0) {
        if (a >= static_cast<std::uint32_t>(scene_.outline_count)) return false;
        scene_.gates[index].outline = &scene_.outlines[a];
      }
      if (!add(depth - 1, index, portals[a].pair, &portals[a])) return false;
    }
    return true;
  }

  void fill(LaneGate& gate, const Portal& portal, double reach, int parent,
            const Portal* entered) const {
    const Frame& frame = portal.frame;
    const Frame& beyond = space_.mouths[portal.pair].frame;
    const Rectangle rectangle = rectangle_of(portal);
    gate = {};
    gate.parent = parent;
    gate.origin = narrow(frame.origin - center_);
    gate.right = narrow(frame.right);
    gate.up = narrow(frame.up);
    gate.normal = narrow(frame.normal);
    if (entered) {
      const Frame& out = space_.mouths[entered->pair].frame;
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
    gate.ball = ball_about(portal, reach, space_.extent);
    // Isolated masses reach no portal.
    for (std::size_t i = 0; i < masses_.size(); ++i) {
      const Vec3d seen = beyond.to_local(space_.masses[masses_[i]].center);
      const Vec3d image{-seen.x, seen.y, -seen.z};
      gate.images[i] = narrow(image);
      const Mass& mass = space_.masses[masses_[i]];
      gate.fades[i] = ends_on(portal, frame.to_world(image), mass.influence);
      scene_.fading = scene_.fading || gate.fades[i];
      const double m = light_sphere(space_, mass.gm);
      const bool binds_light = felt_from(space_.mouths[portal.pair], mass) < m;
      gate.bare2[i] = binds_light ? static_cast<float>(too_near * too_near * m * m) : 0.0f;
      scene_.bare_through = scene_.bare_through || binds_light;
    }
    gate.falls_short = false;
    if (entered)
      for (const Vec3d& from : space_.mouths[entered->pair].vertices)
        gate.falls_short = gate.falls_short || !(farthest(portal, from) < 0.9999 * reach);
    scene_.fading = scene_.fading || gate.falls_short;
  }

  /// Whether some of a portal is further than that from a place, and some nearer.
  [[nodiscard]] static bool ends_on(const Portal& portal, Vec3d from, double influence) {
    return PortalFace(portal).distance(from) < 1.0001 * influence &&
           !(farthest(portal, from) < 0.9999 * influence);
  }

  const Space& space_;
  const ClosestPointCoupling& coupling_;
  Vec3d center_;
  const std::vector<std::uint32_t>& masses_;
  LaneScene& scene_;
};

LaneFace face_of(const Portal& portal, Vec3d center, double reach, double extent) {
  const Rectangle rectangle = rectangle_of(portal);
  return {narrow(portal.frame.origin - center),
          narrow(portal.frame.right),
          narrow(portal.frame.up),
          narrow(portal.frame.normal),
          static_cast<float>(rectangle.half_width),
          static_cast<float>(rectangle.half_height),
          static_cast<float>(portal.height_tolerance()),
          static_cast<float>(reach * reach),
          ball_about(portal, reach, extent)};
}

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

/// Of the cells of a portal's map: `LaneMap::max_nearness`.
float max_nearness(const Space& space, std::uint32_t portal) {
  double most = 1e30;  // no cell's
  for (const BoundLight& light : bound_light(GravitonMapCoupling::name, space.mouths, space.masses,
                                             space.physics.c, space.medium.light_sphere)) {
    if (light.portal != portal) continue;
    const double m = light_sphere(space, space.masses[light.mass].gm);
    most = std::min(most, std::pow(too_near * m, -4.0));
  }
  return static_cast<float>(most);
}

[[nodiscard]] std::string add_maps(const Space& space, const GravitonMapCoupling& coupling,
                                   LanePlan& plan) {
  const std::vector<Portal>& portals = space.mouths;
  const double inverse_c2 = space.medium.uniform_weight() / (space.physics.c * space.physics.c);
  std::vector<std::size_t> first;
  for (std::uint32_t a = 0; a < portals.size(); ++a) {
    const double reach = coupling.exact().reach(a);
    if (!(reach > 0.0)) continue;
    if (plan.scene.map_count == max_lane_portals)
      return fmt::format("more than {} sides of portals act (lanes take {})", max_lane_portals,
                         max_lane_portals);
    const LaneFace face = face_of(portals[a], plan.center, reach, space.extent);
    plan.scene.maps[plan.scene.map_count++] =
        map_of(coupling.grid(a), face, max_nearness(space, a));
    first.push_back(plan.map_cells.size() / 3);
    add_nodes(coupling.grid(a), inverse_c2, plan);
  }
  // Now that the tables grow no more.
  for (std::size_t i = 0; i < first.size(); ++i) {
    plan.scene.maps[i].nodes = plan.map_nodes.data() + 4 * first[i];
    plan.scene.maps[i].cells = plan.map_cells.data() + 3 * first[i];
  }
  return "";
}

/// Says which portal is no rectangle; empty where all are.
[[nodiscard]] std::string odd_portal(const Space& space) {
  for (const Portal& portal : space.mouths)
    if (!(rectangle_of(portal).half_width > 0.0))
      return fmt::format(
          "portal {} is no rectangle, as lanes want it for {} (with closest-point "
          "they take any of up to {} edges)",
          in_quotes(portal.name), space.physics.portal_gravity, max_lane_edges);
  return "";
}

/// `LaneWay::bare2` of a way through one portal.
float bare2_of_way(const Space& space, const ShortestPathCoupling::Image& image,
                   const Portal& portal, LaneScene& scene) {
  const Mass& mass = space.masses[image.mass];
  const double m = light_sphere(space, image.gm);
  if (!(felt_from(space.mouths[portal.pair], mass) < m)) return 0.0f;
  scene.bare_through = true;
  return static_cast<float>(too_near * too_near * m * m);
}

/// Chains of one portal only.
[[nodiscard]] std::string add_ways(const Space& space, const ShortestPathCoupling& coupling,
                                   LanePlan& plan) {
  LaneScene& scene = plan.scene;
  if (coupling.images().size() > max_lane_ways)
    return fmt::format("shortest-path has {} paths from masses through portals (lanes take {})",
                       coupling.images().size(), max_lane_ways);
  std::uint32_t entered = no_portal;
  for (const ShortestPathCoupling::Image& image : coupling.images()) {
    const std::vector<std::uint32_t> chain = coupling.chain(image);
    if (chain.size() > 1)
      return "shortest-path goes through portals in a row (lanes take "
             "physics.portal_gravity_depth = 1)";
    const Portal& portal = space.mouths[chain.front()];
    // Images come portal by portal.
    if (chain.front() != entered && scene.entrance_count == max_lane_portals)
      return fmt::format("more than {} sides of portals act (lanes take {})", max_lane_portals,
                         max_lane_portals);
    if (chain.front() != entered)
      scene.entrances[scene.entrance_count++] = {face_of(portal, plan.center, 0.0, space.extent),
                                                 scene.way_count, scene.way_count};
    entered = chain.front();
    ++scene.entrances[scene.entrance_count - 1].end;
    const Vec3d local = portal.frame.to_local(image.center);
    const Rectangle rectangle = rectangle_of(portal);
    const auto off = [&](double aside) { return static_cast<float>(std::hypot(aside, local.z)); };
    scene.ways[scene.way_count++] = {
        narrow(local),
        static_cast<float>(space.medium.uniform_weight() *
                           gravitational_radius(image.gm, space.physics.c)),
        static_cast<float>(image.core2),
        static_cast<float>(image.influence),
        bare2_of_way(space, image, portal, scene),
        {off(local.y + rectangle.half_height), off(local.x - rectangle.half_width),
         off(local.y - rectangle.half_height), off(local.x + rectangle.half_width)}};
  }
  return "";
}

}  // namespace

double strongest_onset(const Space& space) {
  double strongest = space.physics.min_force;
  const bool none = std::holds_alternative<NoCoupling>(space.coupling) ||
                    std::holds_alternative<PortalMassCoupling>(space.coupling);
  if (none) return strongest;
  for (const Portal& mouth : space.mouths)
    for (const Mass& mass : space.masses) {
      const double distance = felt_from(space.mouths[mouth.pair], mass);
      if (distance < mass.influence)
        strongest = std::max(strongest, mass.gm / (distance * distance));
    }
  return strongest;
}

void add_masses_of_portals(const Space& space, Vec3d center, std::vector<LaneMass>& masses) {
  const auto* coupling = std::get_if<PortalMassCoupling>(&space.coupling);
  if (!coupling) return;
  for (const PortalMassCoupling::Image& image : coupling->images()) {
    const auto gm = static_cast<float>(space.medium.uniform_weight() *
                                       gravitational_radius(image.gm, space.physics.c));
    const auto core2 = static_cast<float>(image.core2);
    const auto influence = static_cast<float>(image.influence);
    masses.push_back({narrow(image.center - center), gm, core2, influence, influence * influence,
                      -1.0f, 1.0f, bare2_of(gm, core2)});
  }
}

std::string add_coupling(const Space& space, LanePlan& plan) {
  const Coupling& coupling = space.coupling;
  if (const auto* closest = std::get_if<ClosestPointCoupling>(&coupling))
    return GatePlanner(space, *closest, plan).plan();
  if (std::holds_alternative<PortalMassCoupling>(coupling) ||
      std::holds_alternative<NoCoupling>(coupling))
    return "";
  if (const std::string odd = odd_portal(space); !odd.empty()) return odd;
  if (const auto* map = std::get_if<GravitonMapCoupling>(&coupling))
    return add_maps(space, *map, plan);
  if (const auto* shortest = std::get_if<ShortestPathCoupling>(&coupling))
    return add_ways(space, *shortest, plan);
  return fmt::format("lanes do not know the coupling {}", in_quotes(space.physics.portal_gravity));
}

}  // namespace portalens
