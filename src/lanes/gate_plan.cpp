// How lanes hold `closest-point`.
#include <fmt/format.h>

#include <algorithm>

#include "core/words.h"
#include "gravity/bound_light.h"
#include "gravity/portal_face.h"
#include "lanes/coupling_layout.h"
#include "lanes/face_plan.h"
#include "lanes/narrow.h"
#include "photon/space.h"

namespace portalens {
namespace {

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
    for (const Portal& portal : space_.mouths) {
      if (coupling_.depth() == 0 || !is_curved(portal.aperture)) continue;
      scene_.any_round = true;
      if (coupling_.depth() > 1)
        return fmt::format(
            "portal {} is an {} (with closest-point lanes take those with "
            "physics.portal_gravity_depth = 1)",
            in_quotes(portal.name), name_of(portal.aperture));
    }
    if (add(coupling_.depth(), -1, no_portal, nullptr)) return "";
    if (masses_.size() > max_lane_masses)
      return fmt::format(
          "through portals {} masses act (lanes take {}; with physics.portal_gravity = "
          "\"portal-mass\" or \"none\" they take more)",
          masses_.size(), max_lane_masses);
    return fmt::format(
        "closest-point goes through portals on more than {} paths ({} has fewer)", max_lane_gates,
        coupling_.depth() > 1 ? "a smaller physics.portal_gravity_depth"
                              : "physics.portal_gravity = \"portal-mass\" or \"none\"");
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
      if (scene_.outline_count > 0) scene_.gates[index].outline = &scene_.outlines[a];
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
      gate.bare2[i] =
          binds_light ? static_cast<float>(too_near_through * too_near_through * m * m) : 0.0f;
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

}  // namespace

std::string CouplingLayout::nearest_points(const ClosestPointCoupling& coupling) {
  return GatePlanner(space_, coupling, plan_).plan();
}

}  // namespace portalens
