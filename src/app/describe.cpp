#include "app/describe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <variant>

#include "app/beyond.h"
#include "app/machine_memory.h"
#include "app/report.h"
#include "app/ring_size.h"
#include "render/manner.h"
#include "render/parallel.h"
#include "render/render.h"

namespace portalens {
namespace {

/// Entries of one list that a person is shown.
constexpr std::size_t max_listed = 40;

std::string place(Vec3d v) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x, v.y, v.z); }

/// Extent of a portal along its `right` and `up`.
std::pair<double, double> size_of(const Portal& portal) {
  const PlaneBox box = box_of(portal.aperture);
  return {box.high_x - box.low_x, box.high_y - box.low_y};
}

Json bodies_json(const World& world) {
  Json bodies = Json::array();
  for (const Body& body : world.appearance.bodies)
    bodies.push_back({{"name", body.name},
                      {"kind", body.kind},
                      {"material", world.appearance.materials[body.material].name},
                      {"mass", body.mass ? Json(world.space.masses[*body.mass].name) : Json()}});
  return bodies;
}

Json masses_json(const World& world) {
  const Space& space = world.space;
  Json masses = Json::array();
  for (const Mass& mass : space.masses) {
    const auto ring = ring_pixels(world, mass);
    masses.push_back({{"name", mass.name},
                      {"mass", mass.gm / space.physics.G},
                      {"center", to_json(mass.center)},
                      {"schwarzschild_radius", schwarzschild_radius(mass.gm, space.physics.c)},
                      {"horizon_radius", mass.has_horizon() ? Json(mass.horizon_radius) : Json()},
                      {"influence_radius", finite_or_null(mass.influence)},
                      {"core_radius", mass.core},
                      {"horizon", mass.horizon},
                      {"ring_pixels", ring ? Json(*ring) : Json()}});
  }
  return masses;
}

Json portals_json(const World& world) {
  const std::span<const Portal> portals = world.space.portals.portals();
  Json list = Json::array();
  for (const Portal& portal : portals) {
    const auto [width, height] = size_of(portal);
    const auto camera = beyond(portal, place_of(world.camera));
    list.push_back(
        {{"name", portal.name},
         {"pair", portals[portal.pair].name},
         {"center", to_json(portal.frame.origin)},
         {"normal", to_json(portal.frame.normal)},
         {"size", {width, height}},
         {"face", name_of(portal.aperture)},
         {"vertices", is_curved(portal.aperture) ? 0 : portal.vertices.size()},
         {"tint", to_json(portal.tint)},
         {"back", portal.two_sided       ? "portal"
                  : portal.back_material ? world.appearance.materials[*portal.back_material].name
                                         : "open"},
         {"camera_beyond", camera ? to_json(*camera) : Json()}});
  }
  return list;
}

Json camera_json(const Camera& camera) {
  const bool perspective = camera.projection == Projection::perspective;
  return {{"type", perspective ? "perspective" : "orthographic"},
          {"position", to_json(camera.position)},
          {"forward", to_json(camera.forward)},
          {"up", to_json(camera.up)},
          {perspective ? "fov" : "size", perspective ? camera.fov : camera.size}};
}

Json film_json(const Film& film) {
  const Development& development = film.development;
  return {{"width", film.width},
          {"height", film.height},
          {"exposure", development.exposure},
          {"tone", tone_names[static_cast<std::size_t>(development.tone)]},
          {"white_balance", development.white_balance ? Json(*development.white_balance) : Json()}};
}

CouplingInput coupling_input(const Space& space) {
  const Physics& physics = space.physics;
  return {space.mouths, space.masses, physics.min_force,
          static_cast<int>(physics.portal_gravity_depth),
          static_cast<int>(physics.graviton_resolution)};
}

CouplingCost coupling_cost(const Space& space) {
  return estimated_cost(space.physics.portal_gravity, coupling_input(space));
}

/// Whether a mouth is the reverse of a portal with two sides: those follow the portals.
bool is_reverse(const Space& space, std::size_t mouth) {
  return mouth >= space.portals.portals().size();
}

/// One entry a portal, if gravity is kept in maps.
std::vector<GravitonMapError> map_errors(const Space& space) {
  std::vector<GravitonMapError> errors;
  if (const auto* map = std::get_if<GravitonMapCoupling>(&space.coupling))
    for (std::uint32_t i = 0; i < map->exact().portal_count(); ++i) errors.push_back(map->error(i));
  return errors;
}

Json gravity_json(const Space& space) {
  const CouplingCost cost = coupling_cost(space);
  Json json = {{"name", space.physics.portal_gravity},
               {"pulls_at_each_place", cost.each_call},
               {"pulls_to_prepare", cost.preparation}};
  const std::vector<GravitonMapError> errors = map_errors(space);
  for (std::size_t i = 0; i < errors.size(); ++i)
    json["map_errors"].push_back({{"portal", space.mouths[i].name},
                                  {"side", is_reverse(space, i) ? "back" : "front"},
                                  {"typical", errors[i].typical},
                                  {"largest", errors[i].largest}});
  return json;
}

Json physics_json(const Space& space) {
  const Physics& physics = space.physics;
  return {{"G", physics.G},
          {"c", physics.c},
          {"min_force", physics.min_force},
          {"law", physics.law},
          {"integrator", physics.integrator},
          {"tolerance", physics.tolerance},
          {"step", physics.step},
          {"max_steps", physics.max_steps},
          {"max_length", physics.max_length},
          {"max_turning", physics.max_turning},
          {"portal_gravity", physics.portal_gravity},
          {"portal_gravity_depth", physics.portal_gravity_depth},
          {"graviton_resolution", physics.graviton_resolution},
          {"max_crossings", space.max_crossings}};
}

/// "3 sphere, 1 quad"
std::string kinds_text(const std::vector<Body>& bodies) {
  std::map<std::string, std::size_t> counts;
  for (const Body& body : bodies) ++counts[body.kind];
  std::string text;
  for (const auto& [kind, count] : counts)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, kind);
  return text.empty() ? "none" : text;
}

std::string mass_text(const World& world, const Mass& mass) {
  const Physics& physics = world.space.physics;
  const double schwarzschild = schwarzschild_radius(mass.gm, physics.c);
  std::string text =
      fmt::format("  {}: M = {:.6g} at {}, r_s = {:.6g}, R = {:.6g}", mass.name,
                  mass.gm / physics.G, place(mass.center), schwarzschild, mass.influence);
  if (mass.has_horizon() && mass.horizon_radius != schwarzschild)
    text += fmt::format(", light ends at {:.6g}", mass.horizon_radius);
  if (mass.core > 0.0) text += fmt::format(", core {:.6g}", mass.core);
  if (!mass.horizon) text += ", no horizon";
  if (const auto ring = ring_pixels(world, mass))
    text += fmt::format("; what is far behind: a ring {:.3g} pixels wide", *ring);
  return text + '\n';
}

std::string portal_text(const World& world, const Portal& portal) {
  const auto [width, height] = size_of(portal);
  const auto& pair = world.space.portals.portals()[portal.pair];
  std::string text =
      fmt::format("  {} -> {}: {:.6g} x {:.6g} at {}, facing {}", portal.name, pair.name, width,
                  height, place(portal.frame.origin), place(portal.frame.normal));
  if (!std::holds_alternative<ConvexPolygon>(portal.aperture))
    text += fmt::format(", {}", name_of(portal.aperture));
  if (portal.two_sided) text += ", and back to back";
  if (portal.back_material)
    text += ", back " + world.appearance.materials[*portal.back_material].name;
  text += '\n';
  const double before = dot(world.camera.position - portal.frame.origin, portal.frame.normal);
  if (const auto camera = beyond(portal, place_of(world.camera)); camera && before >= 0.0)
    text += "    a camera that goes through stands at\n" + as_toml(*camera, "      ");
  return text;
}

std::string light_text(const Appearance& look, const Light& light) {
  const auto index = static_cast<std::size_t>(&light - look.lights.data());
  const auto strength = [](const auto& one) {
    constexpr bool far = Distant<decltype(one)>, all_round = far && !Directed<decltype(one)>;
    return fmt::format("{}{} {}{}", all_round ? "mean " : "", far ? "irradiance" : "power",
                       place(one.power()), far ? " W/m²" : " W");
  };
  return "  " + look.light_names[index] + ": " + std::visit(strength, light) + '\n';
}

template <class Item, class Text>
std::string listed(const char* title, std::span<const Item> items, const Text& text_of) {
  std::string text = fmt::format("{:<12}{}\n", title, items.size());
  for (const Item& item : items.first(std::min(items.size(), max_listed))) text += text_of(item);
  if (items.size() > max_listed)
    text += fmt::format("  ... and {} more (--json lists all)\n", items.size() - max_listed);
  return text;
}

std::string camera_text(const Camera& camera) {
  const bool perspective = camera.projection == Projection::perspective;
  return fmt::format("{} at {} looking {}, {} {:.6g}{}",
                     perspective ? "perspective" : "orthographic", place(camera.position),
                     place(camera.forward), perspective ? "fov" : "size",
                     perspective ? camera.fov : camera.size, perspective ? " degrees" : "");
}

/// What is not as it is by default.
std::string development_text(const Development& development) {
  constexpr Development plain;
  std::string text;
  if (development.exposure != plain.exposure)
    text += fmt::format(", exposure {:g} stops", development.exposure);
  if (development.tone != plain.tone)
    text += fmt::format(", tone {}", tone_names[static_cast<std::size_t>(development.tone)]);
  if (development.white_balance)
    text += fmt::format(", white balance {:g} K", *development.white_balance);
  return text;
}

std::string physics_text(const Space& space) {
  const Physics& p = space.physics;
  const bool adaptive = p.integrator == "adaptive";
  return fmt::format("{}, G = {:g}, c = {:g}, min_force = {:g}; {} ({} {:g})", p.law, p.G, p.c,
                     p.min_force, p.integrator, adaptive ? "tolerance" : "step",
                     adaptive ? p.tolerance : p.step);
}

/// The coupling, what it costs, and how exact it is if that is known.
std::string gravity_text(const Space& space) {
  const CouplingCost cost = coupling_cost(space);
  std::string text =
      fmt::format("{}, depth {}; costs at most {:.3g} pulls of a mass at each place",
                  space.physics.portal_gravity, space.physics.portal_gravity_depth, cost.each_call);
  if (cost.preparation > 0.0) text += fmt::format(", and {:.3g} once", cost.preparation);
  const std::vector<GravitonMapError> errors = map_errors(space);
  for (std::size_t i = 0; i < errors.size(); ++i)
    text +=
        fmt::format("\n  map of {}{}: {:.2g} off closest-point, at worst {:.2g} of the strongest",
                    is_reverse(space, i) ? "the back of " : "", space.mouths[i].name,
                    errors[i].typical, errors[i].largest);
  return text;
}

/// For the whole picture, without layers, on all threads.
MemoryEstimate memory_of(const World& world) {
  return estimated_memory(world, {0, 0, world.film.width, world.film.height}, 0,
                          available_threads(), tile_size_of(world, {}));
}

Json memory_json(const World& world) {
  const MemoryEstimate estimate = memory_of(world);
  return {{"bytes", estimate.total()},
          {"scene", estimate.scene},
          {"picture", estimate.picture},
          {"machine", machine_memory()}};
}

std::string memory_line(const World& world) {
  const MemoryEstimate estimate = memory_of(world);
  return fmt::format("about {}, of it {} for the picture and {} for the scene; there are {}",
                     memory_text(estimate.total()), memory_text(estimate.picture),
                     memory_text(estimate.scene), memory_text(machine_memory()));
}

}  // namespace

Json describe_json(const Scene& scene, const World& world) {
  const Environment& environment = world.appearance.environment;
  Json powers = Json::array();
  for (const Light& light : world.appearance.lights)
    powers.push_back(std::visit([](const auto& one) { return to_json(one.power()); }, light));
  std::vector<std::string> notes = world.remarks;
  notes.insert(notes.end(), scene.notes.begin(), scene.notes.end());
  Json json = {{"scene", world.file.string()},
               {"camera", camera_json(world.camera)},
               {"film", film_json(world.film)},
               {"samples", world.sampling.samples},
               {"seed", world.sampling.seed},
               {"physics", physics_json(world.space)},
               {"gravity_through_portals", gravity_json(world.space)},
               {"environment", environment.image ? Json("image") : to_json(environment.color)},
               {"materials", world.appearance.materials.size()},
               {"objects", bodies_json(world)},
               {"masses", masses_json(world)},
               {"portals", portals_json(world)},
               {"lights", world.appearance.light_names},
               {"light_powers", powers},
               {"memory", memory_json(world)},
               {"warnings", world.warnings},
               {"notes", notes}};
  add_manner(manner_metadata(manner_of(world, {})), json);
  return json;
}

std::string describe_text(const Scene& scene, const World& world) {
  const Space& space = world.space;
  std::string text;
  const auto line = [&](const char* title, const std::string& value) {
    text += fmt::format("{:<12}{}\n", title, value);
  };
  line("scene", world.file.string());
  line("camera", camera_text(world.camera));
  line("film", fmt::format("{} x {}, {} samples a pixel{}", world.film.width, world.film.height,
                           world.sampling.samples, development_text(world.film.development)));
  line("physics", physics_text(space));
  if (!space.portals.empty()) line("gravity", "through portals: " + gravity_text(space));
  line("objects", kinds_text(world.appearance.bodies));
  text += listed("masses", std::span<const Mass>(space.masses),
                 [&](const Mass& mass) { return mass_text(world, mass); });
  text += listed("portals", space.portals.portals(),
                 [&](const Portal& portal) { return portal_text(world, portal); });
  text += listed("lights", std::span<const Light>(world.appearance.lights),
                 [&](const Light& light) { return light_text(world.appearance, light); });
  const Environment& environment = world.appearance.environment;
  line("environment", environment.image
                          ? fmt::format("an image times {}, turned by {:g} degrees",
                                        place(environment.scale), environment.rotation)
                          : place(environment.color));
  const Metadata manner = manner_metadata(manner_of(world, {}));
  line("engine", engine_text(manner));
  line("photons", photon_mode_text(manner));
  line("memory", memory_line(world));
  for (const std::string& warning : world.warnings) text += "warning: " + warning + '\n';
  for (const std::string& remark : world.remarks) text += "note: " + remark + '\n';
  for (const std::string& note : scene.notes) text += "note: " + note + '\n';
  return text;
}

}  // namespace portalens
