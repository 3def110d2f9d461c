#include "world/compile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "core/words.h"
#include "gravity/coupling.h"
#include "gravity/law.h"
#include "world/image_store.h"
#include "world/light_list.h"
#include "world/mesh_store.h"
#include "world/names.h"
#include "world/object_reader.h"
#include "world/stage.h"
#include "world/table_kinds.h"
#include "world/warnings.h"

namespace portalens {
namespace {

constexpr std::int64_t max_allowed_crossings = 10'000;
constexpr std::int64_t max_pixels_along = 65'536;
constexpr std::int64_t max_pixels = std::int64_t{1} << 28;
constexpr std::int64_t max_samples = 1'000'000;

Film film_from(Parameters& parameters) {
  Film film;
  film.width = static_cast<int>(parameters.integer("width", 1, max_pixels_along, film.width));
  film.height = static_cast<int>(parameters.integer("height", 1, max_pixels_along, film.height));
  if (std::int64_t{film.width} * film.height > max_pixels)
    parameters.fault("width", "the film has more than 268 million pixels",
                     "give a smaller width or height");
  film.development = Development::from(parameters);
  return film;
}

Sampling sampling_from(Parameters& parameters) {
  Sampling sampling;
  sampling.samples = parameters.integer("samples", 1, max_samples, sampling.samples);
  sampling.seed =
      parameters.integer("seed", 0, std::numeric_limits<std::int64_t>::max(), sampling.seed);
  return sampling;
}

/// Reads one section with a function of its parameters, and refuses what it did not ask for.
template <class Read>
auto read_section(const Table& table, Faults& faults, const Read& read) {
  Parameters parameters(table, faults);
  auto result = read(parameters);
  parameters.finish();
  return result;
}

std::string in_pulls(double cost, double budget) {
  return fmt::format("about {:.1e} pulls of a mass; the budget is {:.0e}", cost, budget);
}

/// Gravity has to have a motion where it is to act through portals.
void check_passages(const Scene& scene, const Physics& physics, const Objects& objects,
                    Faults& faults) {
  const Portal* barred = barred_portal(physics.portal_gravity, objects.portals);
  if (!barred) return;
  Parameters(scene.physics, faults)
      .fault("portal_gravity",
             fmt::format("portal {} leads through by a {}, and {} asks for a rigid motion",
                         in_quotes(barred->name), name_of(barred->passage),
                         in_quotes(physics.portal_gravity)),
             "give portal_gravity = \"none\"");
}

/// `closest-point` needs finite reaches; and whatever the coupling, its cost stays bounded.
/// equations.md, sec. 5.
void check_portal_gravity(const Scene& scene, const Physics& physics, const Objects& objects,
                          Faults& faults) {
  check_passages(scene, physics, objects, faults);
  if (objects.portals.empty() || physics.portal_gravity_depth == 0) return;
  Parameters parameters(scene.physics, faults);
  const std::string_view coupling = physics.portal_gravity;
  if (physics.min_force == 0.0 &&
      (coupling == ClosestPointCoupling::name || coupling == GravitonMapCoupling::name))
    parameters.fault("min_force",
                     fmt::format("with min_force 0 every reach is infinite, and portal_gravity "
                                 "'{}' never lets a photon go",
                                 coupling),
                     "give a min_force above 0, or portal_gravity 'shortest-path'");
  const std::vector<Portal> mouths = one_sided(objects.portals);
  const CouplingCost cost =
      estimated_cost(coupling, {mouths, objects.masses, physics.min_force,
                                static_cast<int>(physics.portal_gravity_depth),
                                static_cast<int>(physics.graviton_resolution)});
  if (cost.each_call > coupling_budget.each_call)
    parameters.fault("portal_gravity_depth",
                     "at this depth portal gravity would cost, at every place, " +
                         in_pulls(cost.each_call, coupling_budget.each_call),
                     "give a smaller portal_gravity_depth");
  else if (cost.preparation > coupling_budget.preparation)
    parameters.fault(
        "graviton_resolution",
        "the graviton maps would cost " + in_pulls(cost.preparation, coupling_budget.preparation),
        "give a smaller graviton_resolution or portal_gravity_depth");
}

/// Where light ends by the depth of the field, it has to be a hole that it ends in.
void check_cores(const Scene& scene, const Physics& physics, const Objects& objects,
                 Faults& faults) {
  const double greatest = constants_of(make_law(physics.law)).greatest_potential;
  if (std::isinf(greatest)) return;
  double depth = 0.0;
  for (const Mass& mass : objects.masses)
    if (mass.core > 0.0) depth += gravitational_radius(mass.gm, physics.c) / mass.core;
  // Portals with faults have no pair.
  if (physics.portal_gravity == PortalMassCoupling::name && faults.size() == 0) {
    const std::vector<Portal> mouths = one_sided(objects.portals);
    const PortalMassCoupling coupling({mouths, objects.masses, physics.min_force,
                                       static_cast<int>(physics.portal_gravity_depth)});
    for (const PortalMassCoupling::Image& image : coupling.images())
      depth += gravitational_radius(image.gm, physics.c) / std::sqrt(image.core2);
  }
  if (depth < greatest) return;
  Parameters(scene.physics, faults)
      .fault("law",
             fmt::format("the masses with cores are too dense for the law {}: their G M / (c² "
                         "core_radius) come to {:.4g}, and light ends at {:g}",
                         in_quotes(physics.law), depth, greatest),
             "give them larger cores or less mass, or take another law");
}

/// Steps and tolerances are made for the size of the space, to which influences count: what is tiny
/// in it is passed over.
void check_influences(const Scene& scene, const Objects& objects, const Box& extent, Vec3d camera,
                      Faults& faults) {
  constexpr double widest = 1e7;
  Box box = extent;
  box.add(camera);
  for (const Mass& mass : objects.masses) {
    if (!std::isfinite(mass.influence) || mass.influence <= widest * box.diagonal()) continue;
    Parameters(scene.physics, faults)
        .fault(
            "min_force",
            fmt::format("the influence of {} reaches {:.3g} far, and all else of the scene {:.3g}",
                        in_quotes(mass.name), mass.influence, box.diagonal()),
            "give a larger min_force, or 0 for influences without an end");
  }
}

/// What a camera without a place of its own has to see.
Box extent_of(const Objects& objects) {
  Box box;
  for (const Shape& shape : objects.shapes)
    box.add(std::visit([](const auto& s) { return s.bounds(); }, shape));
  for (const Portal& portal : objects.portals)
    for (const Vec3d& vertex : portal.vertices) box.add(vertex);
  for (const Mass& mass : objects.masses) {
    const double reach = mass.horizon ? mass.horizon_radius : mass.core;
    box.add(mass.center - Vec3d{reach, reach, reach});
    box.add(mass.center + Vec3d{reach, reach, reach});
  }
  return box;
}

Camera camera_of(const Scene& scene, const Objects& objects, const Film& film, Faults& faults) {
  const bool staged = is_model_alone(scene) && !objects.shapes.empty();
  const bool chosen = !staged && (!scene.has_camera || is_model_alone(scene));
  const Table said = staged ? staged_camera(scene.camera, objects, film) : scene.camera;
  return read_section(said, faults, [&](Parameters& parameters) {
    return Camera::from(parameters, chosen ? std::optional<Box>(extent_of(objects)) : std::nullopt);
  });
}

/// @param digests  by canonical path
std::vector<UsedFile> used_files(const std::filesystem::path& scene, const Digests& digests) {
  std::error_code ignored;
  const std::filesystem::path folder =
      std::filesystem::weakly_canonical(scene.parent_path() / ".", ignored);
  std::vector<UsedFile> files;
  for (const auto& [path, content] : digests)
    files.push_back({path.lexically_proximate(folder).string(), content});
  return files;
}

void take_lights(std::vector<NamedLight> lights, Appearance& look) {
  for (NamedLight& light : lights) {
    std::visit(
        [&](const auto& one) {
          if constexpr (Directed<decltype(one)>)
            if (const auto disc = one.disc()) look.environment.discs.push_back(*disc);
        },
        light.light);
    if (std::holds_alternative<SkyLight>(light.light)) look.sky_light = look.lights.size();
    look.light_names.push_back(std::move(light.name));
    look.lights.push_back(std::move(light.light));
  }
}

}  // namespace

World compile(const Scene& scene, const CompileOptions& options) {
  Faults faults = scene.faults;
  Names names;
  Digests digests;
  ImageStore images(options.files, faults, digests);
  const ImageLoader load = images.loader(scene.file);
  refuse_unknown_tables(scene, faults);

  const Physics physics = read_section(scene.physics, faults, Physics::from);
  const Film film = read_section(scene.film, faults, film_from);
  const Sampling sampling = read_section(scene.sampler, faults, sampling_from);
  Appearance look;
  std::uint32_t max_crossings = 64;
  look.limits = read_section(scene.shading, faults, [&](Parameters& parameters) {
    max_crossings = static_cast<std::uint32_t>(
        parameters.integer("max_crossings", 0, max_allowed_crossings, max_crossings));
    return ShadingLimits::from(parameters);
  });
  look.environment = read_section(scene.environment, faults, [&](Parameters& parameters) {
    return Environment::from(parameters, load);
  });

  MaterialList materials(scene.materials, names, load, faults);
  MeshStore meshes(scene.file, options.files, images, materials, faults, digests);
  std::vector<NamedLight> lights = read_lights(scene.lights, names, faults);
  Objects objects = read_objects(scene, {physics, names, materials, meshes}, faults);
  set_horizons(make_law(physics.law), objects.masses, physics.c);
  check_portal_gravity(scene, physics, objects, faults);
  check_cores(scene, physics, objects, faults);
  const Camera camera = camera_of(scene, objects, film, faults);
  check_influences(scene, objects, extent_of(objects), camera.position, faults);
  faults.raise();

  look.materials = std::move(materials).take();
  for (NamedLight& light : emitters(objects, look.materials)) lights.push_back(std::move(light));
  add_lamp_bodies(lights, objects, look.materials);
  if (auto sky = sky_light(look.environment, objects, look.materials))
    lights.push_back(std::move(*sky));
  if (is_model_alone(scene))
    for (NamedLight& light : stage_lights(camera, objects)) lights.push_back(std::move(light));
  take_lights(std::move(lights), look);
  look.bodies = std::move(objects.bodies);
  PlannedSpace space(physics, max_crossings, std::move(objects.shapes), std::move(objects.portals),
                     std::move(objects.masses), camera.position);
  World world{scene.file,
              std::move(space),
              std::move(look),
              camera,
              film,
              sampling,
              used_files(scene.file, digests),
              {},
              {}};
  Observations observations = observations_about(world);
  for (const auto& more : {meshes.warnings(), images.warnings(), observations.warnings})
    world.warnings.insert(world.warnings.end(), more.begin(), more.end());
  world.remarks = std::move(observations.remarks);
  if (is_model_alone(scene)) world.remarks.push_back(stage_remark(camera));
  return world;
}

}  // namespace portalens
