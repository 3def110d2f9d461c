#include "world/warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "core/words.h"
#include "gravity/bound_light.h"
#include "world/enclosed_warnings.h"
#include "world/flush_warnings.h"
#include "world/hidden_warnings.h"
#include "world/portal_warnings.h"
#include "world/world.h"

namespace portalens {
namespace {

using Warnings = std::vector<std::string>;

/// A scene may hold pairs by the hundred million. So many items are held against each other, and so
/// many pairs are told by name.
constexpr std::size_t max_compared = 5000, max_told = 100;

/// Warns of the pairs j < i of the first `max_compared` of `count` items that overlap.
template <class Overlap, class Tell>
void about_pairs(std::string_view items, std::size_t count, const Overlap& overlap,
                 const Tell& tell, Warnings& warnings) {
  const std::size_t compared = std::min(count, max_compared);
  std::size_t found = 0;
  for (std::size_t i = 0; i < compared; ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (overlap(j, i) && found++ < max_told) warnings.push_back(tell(j, i));
  if (found > max_told)
    warnings.push_back(fmt::format("{} more pairs of {} overlap", found - max_told, items));
  if (count > compared)
    warnings.push_back(fmt::format("of {} {} the first {} were compared: others may overlap, too",
                                   count, items, compared));
}

bool within_horizon(const World& world, const Mass& mass) {
  return mass.horizon && length(world.camera.position - mass.center) <= mass.horizon_radius;
}

void about_nothing(const World& world, Warnings& warnings) {
  const Space& space = world.space;
  if (space.surfaces.shapes().empty() && space.masses.empty() && space.portals.portals().empty())
    warnings.push_back(
        "the scene has no object: only the environment is seen; add a [[sphere]], a [[mesh]] or "
        "another of docs/scene-format.md");
}

void about_camera(const World& world, Warnings& warnings) {
  for (const Mass& mass : world.space.masses)
    if (within_horizon(world, mass))
      warnings.push_back(fmt::format("the camera lies within the horizon of {}: all is black",
                                     in_quotes(mass.name)));
}

void about_materials(const World& world, Warnings& warnings) {
  for (const Material& material : world.appearance.materials) {
    const double most = max_component(
        std::visit([](const auto& bsdf) { return bsdf.max_reflected(); }, material.bsdf()));
    if (most > 1.0)
      warnings.push_back(
          fmt::format("material {} gives back more light than it gets: its share "
                      "reaches {:.4g}; {}",
                      in_quotes(material.name), most,
                      most > 2.0 ? "colours go from 0 to 1, not to 255"
                                 : "lower one of them (a metal has a diffuse of 0)"));
  }
}

/// Whether the mass's own body is a solid about its centre, to which light then never comes.
bool is_covered(const World& world, const Mass& mass) {
  const auto& bodies = world.appearance.bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies[i].mass || &world.space.masses[*bodies[i].mass] != &mass) continue;
    const Shape& shape = world.space.surfaces.shapes()[i];
    const Box box = std::visit([](const auto& one) { return one.bounds(); }, shape);
    const Vec3d sides = box.high - box.low, aside = mass.center - (box.low + box.high) * 0.5;
    const bool solid = std::holds_alternative<Sphere>(shape) || std::holds_alternative<Cube>(shape);
    if (solid && length(aside) < 0.25 * std::min({sides.x, sides.y, sides.z})) return true;
  }
  return false;
}

void about_masses(const World& world, Warnings& warnings) {
  std::vector<const Mass*> holes;
  for (const Mass& mass : world.space.masses) {
    if (!mass.horizon && mass.core == 0.0 && !is_covered(world, mass))
      warnings.push_back(fmt::format(
          "mass {} has neither a horizon nor a core: near its centre the pull has no bound",
          in_quotes(mass.name)));
    if (mass.horizon) holes.push_back(&mass);
  }
  const auto overlap = [&](std::size_t j, std::size_t i) {
    return length(holes[i]->center - holes[j]->center) <
           holes[i]->horizon_radius + holes[j]->horizon_radius;
  };
  const auto tell = [&](std::size_t j, std::size_t i) {
    return fmt::format("the horizons of {} and {} overlap", in_quotes(holes[j]->name),
                       in_quotes(holes[i]->name));
  };
  about_pairs("horizons", holes.size(), overlap, tell, warnings);
}

/// "2 G M / c²"
std::string in_radii(double count) {
  return count == 1.0 ? "G M / c²" : fmt::format("{:.4g} G M / c²", count);
}

/// Masses whose pull through a portal has no bound, or none that light could leave.
void about_bound_light(const World& world, Warnings& warnings) {
  const Space& space = world.space;
  const Physics& physics = space.physics;
  if (physics.portal_gravity_depth == 0) return;
  const auto portals = space.portals.portals();
  const auto found = bound_light(physics.portal_gravity, portals, space.masses, physics.c,
                                 space.medium.light_sphere);
  for (const BoundLight& one : std::span(found).first(std::min(found.size(), max_told))) {
    const Mass& mass = space.masses[one.mass];
    const Portal& portal = portals[one.portal];
    const double m = space.medium.light_sphere * gravitational_radius(mass.gm, physics.c);
    const std::string where = one.distance > 0.0
                                  ? fmt::format("from as near as {:.3g}, which is", one.distance)
                                  : "from its own place, where its pull has no bound: that is";
    warnings.push_back(fmt::format(
        "through portal {} light feels mass {} {} nearer than {} = {:.3g}, and winds round "
        "it; give the mass a core_radius greater than that, or move it away from portal {}",
        in_quotes(portal.name), in_quotes(mass.name), where, in_radii(space.medium.light_sphere), m,
        in_quotes(portals[portal.pair].name)));
  }
  if (found.size() > max_told)
    warnings.push_back(fmt::format("{} more masses are felt through portals from so near",
                                   found.size() - max_told));
}

/// A surface that no photon can reach, since the horizon of its own mass lies around all of it.
void about_hidden_bodies(const World& world, Warnings& warnings) {
  for (std::size_t i = 0; i < world.appearance.bodies.size(); ++i) {
    const Body& body = world.appearance.bodies[i];
    if (!body.mass) continue;
    const Mass& mass = world.space.masses[*body.mass];
    const Box box =
        std::visit([](const auto& s) { return s.bounds(); }, world.space.surfaces.shapes()[i]);
    const auto reach = [](double low, double high, double center) {
      return std::max(std::fabs(low - center), std::fabs(high - center));
    };
    const Vec3d farthest{reach(box.low.x, box.high.x, mass.center.x),
                         reach(box.low.y, box.high.y, mass.center.y),
                         reach(box.low.z, box.high.z, mass.center.z)};
    if (mass.horizon && length(farthest) <= mass.horizon_radius)
      warnings.push_back(fmt::format(
          "the surface of {} lies within its own horizon (radius {:.4g}) and is never seen",
          in_quotes(body.name), mass.horizon_radius));
  }
}

bool any_answers_lamps(const Appearance& look) {
  return std::any_of(look.bodies.begin(), look.bodies.end(), [&](const Body& body) {
    return look.materials[body.material].answers_lamps();
  });
}

/// So much ambient light was meant to light the scene.
constexpr double meant_to_light = 0.3;

void about_light(const World& world, Warnings& warnings) {
  const Appearance& look = world.appearance;
  if (look.lights.empty() && is_black(look.environment) && look.limits.ambient == Rgb{})
    warnings.push_back("nothing gives light: the picture will be black");
  else if (look.lights.empty() && max_component(look.limits.ambient) < meant_to_light &&
           any_answers_lamps(look))
    warnings.push_back(fmt::format(
        "no lamp lights the scene: surfaces have only shading.ambient ({:.3g}, {:.3g}, {:.3g}), "
        "and the environment is seen, but lights nothing; {}",
        look.limits.ambient.x, look.limits.ambient.y, look.limits.ambient.z,
        world.file.extension() == ".obj"
            ? "the file is taken for a scene of the OBJ dialect: with a line 'o NAME' in it, it is "
              "a model, and lit"
            : "add a [[light]], a shape whose material has emitted, or lights = true in "
              "[environment]"));
}

/// What is odd about a lamp; nothing if nothing is.
template <class Any>
std::string oddity_of(const Any& light, Vec3d up) {
  if (light.power() == Rgb{}) return "gives no light";
  if constexpr (Directed<Any>)
    if (dot(light.towards(), up) < -0.1)
      return "shines from below: 'direction' is the way that its light goes";
  return "";
}

void about_lamps(const World& world, std::vector<std::string>& remarks) {
  const Appearance& look = world.appearance;
  std::size_t found = 0;
  for (std::size_t i = 0; i < look.lights.size(); ++i) {
    const std::string oddity = std::visit(
        [&](const auto& light) { return oddity_of(light, world.camera.up); }, look.lights[i]);
    if (!oddity.empty() && found++ < max_told)
      remarks.push_back(fmt::format("light {} {}", in_quotes(look.light_names[i]), oddity));
  }
}

/// Of few masses each is told, of many how many they are.
void about_influences(const World& world, std::vector<std::string>& remarks) {
  constexpr std::size_t few = 3;
  std::vector<std::string> found;
  for (const Mass& mass : world.space.masses) {
    const double distance = length(world.camera.position - mass.center);
    if (within_horizon(world, mass) || !(distance < mass.influence)) continue;
    if (std::isfinite(mass.influence))
      found.push_back(fmt::format("{} (distance {:.4g}, radius {:.4g})", in_quotes(mass.name),
                                  distance, mass.influence));
  }
  if (found.size() > few)
    remarks.push_back(
        fmt::format("the camera lies within the influences of {} masses", found.size()));
  else
    for (const std::string& one : found)
      remarks.push_back("the camera lies within the influence of " + one);
}

/// Whoever thinks in radians asks for a view of half a degree.
void about_narrow_view(const World& world, std::vector<std::string>& remarks) {
  constexpr double half_a_turn = std::numbers::pi;
  const Camera& camera = world.camera;
  if (camera.projection == Projection::perspective && camera.fov < half_a_turn)
    remarks.push_back(
        fmt::format("the camera's fov is {:.4g} degrees; if that was meant in radians, "
                    "it is {:.4g}",
                    camera.fov, camera.fov * 180.0 / std::numbers::pi));
}

/// What the end of a mass's influence takes from the turning of light: of a straight line past it
/// at distance b, 2 m/b (1 - sqrt(1 - b²/R²)); all of it from b = R on.
void about_cut_pulls(const World& world, std::vector<std::string>& remarks) {
  constexpr double noticed = 0.01;  // radians
  constexpr double degrees = 180.0 / std::numbers::pi;
  std::size_t found = 0;
  for (const Mass& mass : world.space.masses) {
    if (!std::isfinite(mass.influence)) continue;
    const double m =
        world.space.medium.far_weight * gravitational_radius(mass.gm, world.space.physics.c);
    const double at_end = 2.0 * m / mass.influence;
    if (!(at_end > noticed) || ++found > max_told) continue;
    const double at_half = 2.0 * at_end * (1.0 - std::sqrt(0.75));
    remarks.push_back(fmt::format(
        "the pull of {} ends at {:.4g}, its radius of influence (physics.min_force): light that "
        "passes there turns by {:.3g} degrees less than by a pull without end, at half of that by "
        "{:.3g} degrees (trace tells it of any photon); a smaller min_force takes the end further "
        "out",
        in_quotes(mass.name), mass.influence, degrees * at_end, degrees * at_half));
  }
  if (found > max_told)
    remarks.push_back(fmt::format("the pulls of {} more masses end likewise", found - max_told));
}

}  // namespace

Observations observations_about(const World& world) {
  Observations found;
  about_nothing(world, found.warnings);
  about_camera(world, found.warnings);
  about_materials(world, found.warnings);
  about_masses(world, found.warnings);
  about_bound_light(world, found.warnings);
  about_hidden_bodies(world, found.warnings);
  about_cut_pulls(world, found.remarks);
  observe_flush_faces(world, found);
  warn_about_portals(world, found.warnings);
  warn_of_walled_up_portals(world, found.warnings);
  about_light(world, found.warnings);
  about_lamps(world, found.remarks);
  remark_on_hidden_quads(world, found.remarks);
  observe_enclosed(world, found);
  about_narrow_view(world, found.remarks);
  about_influences(world, found.remarks);
  return found;
}

}  // namespace portalens
