#include "lanes/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/words.h"
#include "lanes/face_plan.h"
#include "photon/radau.h"
#include "photon/space.h"

namespace portalens {
namespace {

/// Floats can't keep a finer one.
constexpr double finest_tolerance = 1e-5;

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

/// What of the portals lanes don't take.
std::string portal_refusal(const Space& space) {
  const auto portals = space.portals.portals();
  if (portals.size() > max_lane_portals)
    return fmt::format("{} portals are there (lanes take {})", portals.size(), max_lane_portals);
  for (const Portal& portal : portals)
    if (std::string why = lay_out_face(portal).refusal; !why.empty()) return why;
  return "";
}

/// What of a law that is not uniform lanes don't do.
std::string law_refusal(const Space& space, const LaneScene& scene) {
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

}  // namespace

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

std::string place_refusal(const Space& space, const LanePlan& plan) {
  if (std::string why = scale_refusal(space, plan); !why.empty()) return why;
  if (std::string why = strewn_refusal(space, plan.center); !why.empty()) return why;
  return portal_refusal(space);
}

std::string field_refusal(const Space& space, const LaneScene& scene) {
  if (!space.medium.uniform)
    if (std::string why = law_refusal(space, scene); !why.empty()) return why;
  if (looks_through(scene) && scene.many.count > 0)
    return fmt::format("through portals {} masses act (lanes take {})", scene.many.count,
                       max_lane_masses);
  return "";
}

bool looks_through(const LaneScene& scene) {
  return scene.gate_count + scene.map_count + scene.way_count > 0;
}

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

}  // namespace portalens
